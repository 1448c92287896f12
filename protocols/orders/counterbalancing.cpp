#include "protocols/orders/counterbalancing.h"

#include <utility>

#include "protocols/files/errors.h"
#include "protocols/orders/extra_trials.h"
#include "protocols/orders/lists_of_one_piece.h"
#include "protocols/orders/running_orders.h"
#include "protocols/orders/same_different.h"
#include "protocols/orders/trays.h"

namespace protocols {

namespace {

/// Checks the counts only: a design needs nothing else of a protocol.
void refuseWithoutCounts(const Protocol& protocol)
{
    const auto refuse = [](const std::string& what, const std::string& expected) {
        throw badInput({.what = what, .where = "protocol", .expected = expected, .nextStep = "correct the protocol"});
    };
    if (protocol.participants < 1 || protocol.fabricCount < 1 || protocol.conditions.empty() || protocol.phases.empty())
        refuse("there is nothing to counterbalance", "at least one participant, fabric, condition and phase");
    for (const Phase& phase : protocol.phases) {
        const auto* choice = std::get_if<ForcedChoice>(&phase.task);
        if (choice && (choice->alternatives < 2 || choice->alternatives > protocol.fabricCount))
            refuse(
                std::to_string(choice->alternatives) + " alternatives among " + std::to_string(protocol.fabricCount) + " fabrics",
                "at least two alternatives and no more than fabrics");
    }
    if (protocol.fabricCount > 100) refuse(std::to_string(protocol.fabricCount) + " fabrics", "at most 100");
}

std::vector<std::vector<Tray>> traysOfTrueFabrics(const std::vector<std::vector<Rendering>>& orders)
{
    std::vector<std::vector<Tray>> trays;
    for (const auto& order : orders) {
        auto& list = trays.emplace_back();
        for (const Rendering& rendering : order) list.push_back({rendering.fabric});
    }
    return trays;
}

/// [participant][presentation] of one phase, under one instruction or none.
using Lists = std::vector<std::vector<DesignTrial>>;

/// The presentations of the conditions, with the piece on the tray where it is one; choices get their trays later.
Lists listsOf(const Phase& asked, int phase, const StudySize& size, Random& orderDraws, Random& trayDraws)
{
    const auto rule = trayRuleOf(asked.task);
    const bool isHidden = std::holds_alternative<TrueAmongFoils>(rule);
    auto orders = drawRunningOrders(size, isHidden ? FabricOrder::Drawn : FabricOrder::Even, orderDraws);
    std::vector<std::vector<Tray>> trays;
    std::visit(Overloaded{[](const TrueAmongFoils&) {}, [&](const TrueAlone&) { trays = traysOfTrueFabrics(orders); },
                          [&](const TrueOrOther&) {
                              auto drawn = drawSameDifferent(orders, size, trayDraws);
                              orders = std::move(drawn.orders);
                              trays = std::move(drawn.trays);
                          }},
               rule);
    Lists lists;
    for (std::size_t participant = 0; participant < orders.size(); ++participant) {
        auto& list = lists.emplace_back();
        for (std::size_t at = 0; at < orders[participant].size(); ++at) {
            const Rendering& shown = orders[participant][at];
            list.push_back({phase, shown.label, shown.fabric, trays.empty() ? Tray{} : std::move(trays[participant][at])});
        }
    }
    return lists;
}

/// Trays of choices. Foils are drawn for all presentations alike, so that trays do not tell catch trials and anchors.
void layTrays(Lists& lists, const Phase& asked, int pieces, const StudySize& size, Random& random)
{
    std::vector<std::vector<Rendering>> orders;
    for (const auto& list : lists) {
        auto& order = orders.emplace_back();
        for (const DesignTrial& trial : list)
            order.push_back({trial.anchor == AnchorKind::None && trial.label >= 0 ? trial.label : additionalLabel, trial.fabric});
    }
    auto trays = drawTrays(orders, size, pieces, asked.trayAim, random);
    for (std::size_t participant = 0; participant < lists.size(); ++participant)
        for (std::size_t at = 0; at < lists[participant].size(); ++at)
            lists[participant][at].alternatives = std::move(trays[participant][at]);
}

Lists drawLists(const Protocol& protocol, int phase, const StudySize& size, std::uint64_t seed, const std::string& purpose)
{
    const Phase& asked = protocol.phases[static_cast<std::size_t>(phase)];
    Random orderDraws = Random::stream(seed, purpose + "/orders");
    Random trayDraws = Random::stream(seed, purpose + "/trays");
    const auto rule = trayRuleOf(asked.task);
    const auto* foils = std::get_if<TrueAmongFoils>(&rule);
    if (foils == nullptr && asked.catchTrials + asked.anchors.presentations() > 0)
        return drawListsOfOnePiece(asked, phase, size, protocol.breakAfterPresentations, orderDraws, trayDraws);
    Lists lists = listsOf(asked, phase, size, orderDraws, trayDraws);
    if (foils == nullptr) return lists;
    ExtraTrials extraTrials(asked, size, protocol.breakAfterPresentations, Random::stream(seed, purpose + "/extra trials"));
    for (auto& list : lists) list = extraTrials.with(list);
    layTrays(lists, asked, foils->pieces, size, trayDraws);
    return lists;
}

void append(std::vector<DesignTrial>& list, const std::vector<DesignTrial>& trials, std::optional<int> instruction)
{
    for (DesignTrial trial : trials) {
        trial.instruction = instruction;
        list.push_back(std::move(trial));
    }
}

/// The whole list of the phase once under each instruction.
void drawInstructed(Design& design, const Protocol& protocol, int phase, const StudySize& size, std::uint64_t seed,
                    const std::string& purpose)
{
    const Phase& asked = protocol.phases[static_cast<std::size_t>(phase)];
    std::vector<Lists> byInstruction;
    for (int place = 0; place < asked.runs(); ++place)
        byInstruction.push_back(drawLists(protocol, phase, size, seed, purpose + "/instruction " + std::to_string(place)));
    Random draws = Random::stream(seed, purpose + "/instructions");
    const auto orders = drawInstructionOrders(size.participants, asked.runs(), draws);
    for (std::size_t participant = 0; participant < orders.size(); ++participant)
        for (const int place : orders[participant])
            append(design.participants[participant], byInstruction[static_cast<std::size_t>(place)][participant], place);
}

}  // namespace

Design drawDesign(const Protocol& protocol, std::uint64_t seed)
{
    refuseWithoutCounts(protocol);
    const StudySize size{protocol.participants, static_cast<int>(protocol.conditions.size()), protocol.fabricCount};
    Design design;
    design.participants.resize(static_cast<std::size_t>(size.participants));
    for (std::size_t phase = 0; phase < protocol.phases.size(); ++phase) {
        const std::string purpose = "design/phase " + std::to_string(phase);
        if (protocol.phases[phase].instructions.empty()) {
            const Lists lists = drawLists(protocol, static_cast<int>(phase), size, seed, purpose);
            for (std::size_t k = 0; k < lists.size(); ++k) append(design.participants[k], lists[k], std::nullopt);
        } else {
            drawInstructed(design, protocol, static_cast<int>(phase), size, seed, purpose);
        }
    }
    return design;
}

}  // namespace protocols
