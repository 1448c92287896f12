#include "protocols/counterbalancing.h"

#include <utility>

#include "protocols/extra_trials.h"
#include "protocols/files/errors.h"
#include "protocols/running_orders.h"
#include "protocols/trays.h"

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

std::vector<std::vector<Tray>> traysFor(const Phase& phase, const std::vector<std::vector<Rendering>>& orders,
                                        const StudySize& size, Random& random)
{
    const auto amongFoils = [&](const TrueAmongFoils& rule) {
        return drawTrays(orders, size, rule.pieces, phase.trayAim, random);
    };
    return std::visit(Overloaded{amongFoils, [&](const TrueAlone&) { return traysOfTrueFabrics(orders); },
                                 [&](const TrueOrOther&) { return drawSameDifferentTrays(orders, size, random); }},
                      trayRuleOf(phase.task));
}

/// [participant][presentation] of one phase, under one instruction or none.
using Lists = std::vector<std::vector<DesignTrial>>;

Lists drawLists(const Protocol& protocol, int phase, const StudySize& size, std::uint64_t seed, const std::string& purpose)
{
    const Phase& asked = protocol.phases[static_cast<std::size_t>(phase)];
    Random orderDraws = Random::stream(seed, purpose + "/orders");
    Random trayDraws = Random::stream(seed, purpose + "/trays");
    const auto orders = drawRunningOrders(size, orderDraws);
    auto trays = traysFor(asked, orders, size, trayDraws);
    Random catchDraws = Random::stream(seed, purpose + "/catch trials");
    AnchorDraws anchorDraws(asked, size, protocol.breakAfterPresentations, Random::stream(seed, purpose + "/anchors"));
    Lists lists;
    for (std::size_t participant = 0; participant < orders.size(); ++participant) {
        std::vector<DesignTrial> trials;
        for (std::size_t at = 0; at < orders[participant].size(); ++at)
            trials.push_back(
                {phase, orders[participant][at].label, orders[participant][at].fabric, std::move(trays[participant][at])});
        if (asked.catchTrials > 0) trials = withCatchTrials(trials, asked, size.fabrics, asked.catchTrials, catchDraws);
        if (asked.anchors.presentations() > 0) trials = anchorDraws.with(trials);
        lists.push_back(std::move(trials));
    }
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
