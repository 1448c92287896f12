#include "protocols/records/balance.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "protocols/orders/foil_sets.h"
#include "protocols/orders/running_orders.h"

namespace protocols {

namespace {

/// With more possible foil sets most are never used, and counting each of them is pointless.
constexpr std::int64_t mostFoilSets = 5000;

using Key = std::vector<int>;
using Counts = std::map<Key, int>;
using Range = BalanceCertificate::Range;

/// The trials of one phase, under one of its instructions, by participant.
using PhaseTrials = std::vector<std::vector<DesignTrial>>;

/// Lists that are drawn and balanced on their own: the phases, each once for each of its instructions.
struct ListOfPhase {
    int phase = 0;
    std::optional<int> instruction;
};

std::vector<ListOfPhase> listsOf(const Protocol& protocol)
{
    std::vector<ListOfPhase> lists;
    for (std::size_t i = 0; i < protocol.phases.size(); ++i) {
        const Phase& phase = protocol.phases[i];
        if (phase.instructions.empty()) lists.push_back({static_cast<int>(i), std::nullopt});
        for (std::size_t k = 0; k < phase.instructions.size(); ++k) lists.push_back({static_cast<int>(i), static_cast<int>(k)});
    }
    return lists;
}

bool isIn(const ListOfPhase& list, const DesignTrial& trial)
{
    return trial.phase == list.phase && trial.instruction == list.instruction;
}

bool showsCondition(const DesignTrial& trial) { return trial.label >= 0 && trial.anchor == AnchorKind::None; }

PhaseTrials trialsOf(const Design& design, const ListOfPhase& list)
{
    PhaseTrials trials;
    for (const auto& participant : design.participants) {
        auto& own = trials.emplace_back();
        std::ranges::copy_if(participant, std::back_inserter(own), [&](const DesignTrial& trial) { return isIn(list, trial); });
    }
    return trials;
}

PhaseTrials withoutOthers(PhaseTrials trials)
{
    for (auto& own : trials) std::erase_if(own, [](const DesignTrial& trial) { return !showsCondition(trial); });
    return trials;
}

/// Calls `visit(participant, trial)` for every trial.
template <class Visit>
void forEach(const PhaseTrials& trials, Visit visit)
{
    for (std::size_t participant = 0; participant < trials.size(); ++participant)
        for (const DesignTrial& trial : trials[participant]) visit(static_cast<int>(participant), trial);
}

Range rangeOf(std::string what, const Counts& counts)
{
    Range range{std::move(what), 0, 0};
    if (counts.empty()) return range;
    const auto [least, most] = std::ranges::minmax_element(counts, {}, &Counts::value_type::second);
    range.min = least->second;
    range.max = most->second;
    return range;
}

/// Every cell of the given sizes at 0, so that combinations that never occur count as 0.
Counts emptyTable(const std::vector<int>& sizes)
{
    std::vector<Key> keys{{}};
    for (const int size : sizes) {
        std::vector<Key> longer;
        for (const Key& key : keys)
            for (int i = 0; i < size; ++i) {
                longer.push_back(key);
                longer.back().push_back(i);
            }
        keys = std::move(longer);
    }
    Counts counts;
    for (Key& key : keys) counts.emplace_hint(counts.end(), std::move(key), 0);
    return counts;
}

Counts orderedPairs(const PhaseTrials& trials, int kinds, int DesignTrial::*member)
{
    Counts counts;
    for (int a = 0; a < kinds; ++a)
        for (int b = 0; b < kinds; ++b)
            if (a != b || mayRepeat(kinds)) counts[{a, b}] = 0;
    for (const auto& own : trials)
        for (std::size_t i = 1; i < own.size(); ++i)
            if (const Key pair{own[i - 1].*member, own[i].*member}; counts.contains(pair)) ++counts[pair];
    return counts;
}

/// Counts of each kind in each stretch of `kinds` positions.
Counts perStretch(const PhaseTrials& trials, int kinds, int stretches, int DesignTrial::*member)
{
    Counts counts = emptyTable({stretches, kinds});
    for (const auto& own : trials)
        for (std::size_t i = 0; i < own.size() && static_cast<int>(i) / kinds < stretches; ++i)
            ++counts[{static_cast<int>(i) / kinds, own[i].*member}];
    return counts;
}

/// What lies alone on the trays of all presentations.
PhaseTrials laidAlone(PhaseTrials trials)
{
    for (auto& own : trials)
        for (DesignTrial& trial : own) trial.fabric = trial.alternatives.at(0);
    return trials;
}

/// `all`: with catch trials and anchors. A fabric that comes again after one of these does not come immediately.
int repeatsIn(const PhaseTrials& all, const Protocol& protocol, bool isAlone)
{
    const bool ofLabels = !mayRepeat(static_cast<int>(protocol.conditions.size())), ofFabrics = !mayRepeat(protocol.fabricCount);
    int repeats = 0;
    for (const auto& own : all) {
        const DesignTrial* before = nullptr;
        for (std::size_t i = 0; i < own.size(); ++i) {
            const bool isOf = showsCondition(own[i]);
            const bool areOf = i > 0 && isOf && showsCondition(own[i - 1]);
            const bool isFabric =
                isAlone ? i > 0 && own[i - 1].alternatives == own[i].alternatives : areOf && own[i - 1].fabric == own[i].fabric;
            const bool isLabel = isOf && before != nullptr && before->label == own[i].label;
            repeats += (ofFabrics && isFabric) || (ofLabels && isLabel);
            if (isOf) before = &own[i];
        }
    }
    return repeats;
}

FoilSet foilsOf(const DesignTrial& trial)
{
    FoilSet foils;
    std::ranges::copy_if(trial.alternatives, std::back_inserter(foils), [&](int fabric) { return fabric != trial.fabric; });
    std::ranges::sort(foils);
    return foils;
}

int slotOf(const DesignTrial& trial, int fabric)
{
    return static_cast<int>(std::ranges::find(trial.alternatives, fabric) - trial.alternatives.begin());
}

int repeatedFoilSets(const PhaseTrials& trials)
{
    int repeated = 0;
    std::set<std::pair<Key, FoilSet>> seen;
    forEach(trials, [&](int participant, const DesignTrial& trial) {
        if (!seen.insert({{participant, trial.fabric}, foilsOf(trial)}).second) ++repeated;
    });
    return repeated;
}

Counts foilSetUses(const PhaseTrials& trials, int fabrics, int foils)
{
    Counts counts;
    const auto keyOf = [](int trueFabric, const FoilSet& set) {
        Key key{trueFabric};
        key.insert(key.end(), set.begin(), set.end());
        return key;
    };
    for (int fabric = 0; fabric < fabrics; ++fabric)
        for (const FoilSet& set : allFoilSets(fabrics, fabric, foils)) counts[keyOf(fabric, set)] = 0;
    forEach(trials, [&](int, const DesignTrial& trial) { ++counts[keyOf(trial.fabric, foilsOf(trial))]; });
    return counts;
}

void addChoiceRanges(const PhaseTrials& trials, const Protocol& protocol, int alternatives, const std::string& phase,
                     std::vector<Range>& ranges)
{
    const int people = static_cast<int>(trials.size());
    const int fabrics = protocol.fabricCount;
    Counts slots = emptyTable({people, fabrics, alternatives});
    Counts labelSlots = emptyTable({static_cast<int>(protocol.conditions.size()), alternatives});
    Counts asFoil = emptyTable({people, fabrics});
    Counts foilSlots = emptyTable({people, fabrics, alternatives});
    forEach(trials, [&](int participant, const DesignTrial& trial) {
        ++slots[{participant, trial.fabric, slotOf(trial, trial.fabric)}];
        ++labelSlots[{trial.label, slotOf(trial, trial.fabric)}];
        for (const int foil : foilsOf(trial)) {
            ++asFoil[{participant, foil}];
            ++foilSlots[{participant, foil, slotOf(trial, foil)}];
        }
    });
    if (combinations(fabrics - 1, alternatives - 1, mostFoilSets + 1) <= mostFoilSets)
        ranges.push_back(rangeOf("foil sets per true fabric" + phase, foilSetUses(trials, fabrics, alternatives - 1)));
    ranges.push_back(rangeOf("true slots per participant and fabric" + phase, slots));
    ranges.push_back(rangeOf("true slots per condition" + phase, labelSlots));
    ranges.push_back(rangeOf("a fabric as foil per participant" + phase, asFoil));
    ranges.push_back(rangeOf("slots of a foil per participant" + phase, foilSlots));
}

/// "Q1", "Q2-Q4" or "Q1 (speed)"
std::string nameOf(const Phase& phase, std::optional<int> instruction)
{
    if (phase.questions.empty()) return "";
    const std::string first = phase.questions.front().id.value;
    const std::string name = phase.questions.size() == 1 ? first : first + "-" + phase.questions.back().id.value;
    if (!instruction) return name;
    return name + " (" + phase.instructions.at(static_cast<std::size_t>(*instruction)).id.value + ")";
}

/// With the pieces of catch trials and anchors, which the operator lays, too.
std::optional<BalanceCertificate::Handling> handlingOf(const Design& design, const ListOfPhase& list, const std::string& name)
{
    BalanceCertificate::Handling handling{name, 0, 0};
    int changes = 0;
    for (const auto& trials : design.participants)
        for (std::size_t at = 1; at < trials.size(); ++at) {
            if (!isIn(list, trials[at]) || !isIn(list, trials[at - 1])) continue;
            const auto& before = trials[at - 1].alternatives;
            const auto& after = trials[at].alternatives;
            ++changes;
            for (std::size_t slot = 0; slot < after.size(); ++slot) {
                const auto earlier = std::ranges::find(before, after[slot]);
                handling.piecesPutOn += earlier == before.end();
                handling.piecesMoved += earlier != before.end() && earlier - before.begin() != static_cast<std::ptrdiff_t>(slot);
            }
        }
    if (changes == 0) return std::nullopt;
    handling.piecesPutOn /= changes;
    handling.piecesMoved /= changes;
    return handling;
}

std::string twoDecimals(double value)
{
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 2).ptr;
    return {text.data(), end};
}

/// What was counted, and the count, in words.
std::vector<std::pair<std::string, std::string>> linesOf(const BalanceCertificate& certificate)
{
    std::vector<std::pair<std::string, std::string>> lines;
    for (const Range& range : certificate.ranges) {
        const std::string least = std::to_string(range.min);
        lines.emplace_back(range.what, range.min == range.max ? least : least + " to " + std::to_string(range.max));
    }
    for (const auto& handling : certificate.handling)
        lines.emplace_back(
            "pieces per presentation, " + handling.phase,
            twoDecimals(handling.piecesPutOn) + " put on, " + twoDecimals(handling.piecesMoved) + " moved to another slot");
    lines.emplace_back("immediate repeats of a condition or fabric", std::to_string(certificate.immediateRepeats));
    lines.emplace_back("foil sets repeated within participant and true fabric", std::to_string(certificate.repeatedFoilPairs));
    return lines;
}

/// In both kinds of trays: no rule holds for a participant.
bool isAsChanceMakesIt(const std::string& what)
{
    return what.starts_with("true slots per participant") || what.starts_with("slots of a foil per participant");
}

}  // namespace

BalanceCertificate balanceOf(const Design& design, const Protocol& protocol)
{
    const int labels = static_cast<int>(protocol.conditions.size());
    const int fabrics = protocol.fabricCount;
    BalanceCertificate certificate;
    auto& ranges = certificate.ranges;
    for (const ListOfPhase& list : listsOf(protocol)) {
        const Phase& asked = protocol.phases[static_cast<std::size_t>(list.phase)];
        const PhaseTrials all = trialsOf(design, list), trials = withoutOthers(all);
        const std::string name = nameOf(asked, list.instruction);
        const std::string phase = name.empty() ? "" : ", " + name;
        if (auto handling = handlingOf(design, list, name)) certificate.handling.push_back(std::move(*handling));
        Counts renderings = emptyTable({static_cast<int>(design.participants.size()), labels, fabrics});
        forEach(trials, [&](int participant, const DesignTrial& t) { ++renderings[{participant, t.label, t.fabric}]; });
        ranges.push_back(rangeOf("presentations of a rendering per participant" + phase, renderings));
        ranges.push_back(rangeOf("ordered pairs of conditions" + phase, orderedPairs(trials, labels, &DesignTrial::label)));
        ranges.push_back(
            rangeOf("a condition per stretch of the order" + phase, perStretch(trials, labels, fabrics, &DesignTrial::label)));
        const TrayRule rule = trayRuleOf(asked.task);
        const bool isAlone = std::holds_alternative<TrueAlone>(rule);
        certificate.immediateRepeats += repeatsIn(all, protocol, isAlone);
        const auto* foils = std::get_if<TrueAmongFoils>(&rule);
        if (!foils) {
            const PhaseTrials felt = isAlone ? laidAlone(all) : trials;
            std::size_t length = static_cast<std::size_t>(labels * fabrics);
            for (const auto& own : felt) length = std::max(length, own.size());
            const int stretches = static_cast<int>(length) / fabrics;
            ranges.push_back(rangeOf("ordered pairs of fabrics" + phase, orderedPairs(felt, fabrics, &DesignTrial::fabric)));
            ranges.push_back(
                rangeOf("a fabric per stretch of the order" + phase, perStretch(felt, fabrics, stretches, &DesignTrial::fabric)));
            continue;
        }
        addChoiceRanges(trials, protocol, foils->pieces, phase, ranges);
        certificate.repeatedFoilPairs += repeatedFoilSets(trials);
    }
    return certificate;
}

BalanceCertificate balanceOfExamples(const Protocol& protocol)
{
    constexpr std::int64_t mostForThree = 5000;
    const std::int64_t presentations = std::int64_t{protocol.presentations()} * protocol.participants;
    const std::uint64_t examples = presentations > mostForThree ? 1 : 3;
    BalanceCertificate joined = balanceOf(drawDesign(protocol, 1), protocol);
    for (std::uint64_t seed = 2; seed <= examples; ++seed) {
        const BalanceCertificate next = balanceOf(drawDesign(protocol, seed), protocol);
        for (std::size_t i = 0; i < joined.ranges.size(); ++i) {
            joined.ranges[i].min = std::min(joined.ranges[i].min, next.ranges[i].min);
            joined.ranges[i].max = std::max(joined.ranges[i].max, next.ranges[i].max);
        }
        joined.immediateRepeats = std::max(joined.immediateRepeats, next.immediateRepeats);
        joined.repeatedFoilPairs = std::max(joined.repeatedFoilPairs, next.repeatedFoilPairs);
    }
    return joined;
}

nlohmann::ordered_json jsonOf(const BalanceCertificate& certificate)
{
    nlohmann::ordered_json ranges = nlohmann::ordered_json::array();
    for (const auto& range : certificate.ranges) ranges.push_back({{"what", range.what}, {"min", range.min}, {"max", range.max}});
    nlohmann::ordered_json pieces = nlohmann::ordered_json::array();
    for (const auto& handling : certificate.handling)
        pieces.push_back({{"phase", handling.phase}, {"put_on", handling.piecesPutOn}, {"moved", handling.piecesMoved}});
    return {{"balance", ranges},
            {"pieces_per_presentation", pieces},
            {"immediate_repeats", certificate.immediateRepeats},
            {"repeated_foil_pairs", certificate.repeatedFoilPairs}};
}

std::string describe(const BalanceCertificate& certificate)
{
    std::string text;
    for (const auto& [what, value] : linesOf(certificate)) text += what + ": " + value + "\n";
    return text;
}

std::string describePrice(const BalanceCertificate& fewSwaps, const BalanceCertificate& evenSlots)
{
    const auto lines = linesOf(fewSwaps), others = linesOf(evenSlots);
    std::string text;
    for (std::size_t i = 0; i < lines.size() && i < others.size(); ++i)
        if (lines[i] != others[i] && !isAsChanceMakesIt(lines[i].first))
            text += lines[i].first + ": " + lines[i].second + " (even slots: " + others[i].second + ")\n";
    return text;
}

}  // namespace protocols
