#include "study/leaks/tray_counts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "protocols/random.h"
#include "study/leaks/questions.h"
#include "study/leaks/tally.h"

namespace study::leaks {

namespace {

using TrialNumbers = std::vector<std::size_t>;

std::vector<TrialNumbers> listsIn(const SeenStudy& study)
{
    std::vector<TrialNumbers> lists;
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        if (lists.empty() || !study.trials[i].isInListOf(study.trials[lists.back().back()])) lists.emplace_back();
        lists.back().push_back(i);
    }
    return lists;
}

using PieceSet = std::set<std::string>;

PieceSet setOf(const SeenTrial& trial) { return {trial.tray.begin(), trial.tray.end()}; }

/// One participant's trays of one list.
class TrayList {
public:
    TrayList(const SeenStudy& study, const TrialNumbers& numbers)
    {
        for (const std::size_t number : numbers) {
            const SeenTrial& trial = study.trials[number];
            m_sets.push_back(setOf(trial));
            auto& slots = m_slots.emplace_back();
            for (std::size_t slot = 0; slot < trial.tray.size(); ++slot) slots.emplace_back(trial.tray[slot], slot);
            for (const auto& lies : slots) ++m_inSlots[lies];
        }
    }

    std::size_t size() const { return m_sets.size(); }

    long traysOf(const std::string& piece, std::size_t begin, std::size_t end) const
    {
        long count = 0;
        for (std::size_t at = begin; at < end; ++at) count += m_sets[at].contains(piece);
        return count;
    }
    long rarest(std::size_t at) const { return std::ranges::min(traysOfEach(at, 0, size())); }
    long commonest(std::size_t at) const { return std::ranges::max(traysOfEach(at, 0, size())); }
    long before(std::size_t at) const { return std::ranges::min(traysOfEach(at, 0, at)); }
    long after(std::size_t at) const { return std::ranges::min(traysOfEach(at, at + 1, size())); }
    long sameSets(std::size_t at, std::size_t end) const
    {
        return std::count(m_sets.begin(), m_sets.begin() + static_cast<std::ptrdiff_t>(end), m_sets[at]);
    }
    long sharedWith(std::size_t at, std::size_t other) const
    {
        return other >= size()
                   ? -1
                   : std::ranges::count_if(m_sets[at], [&](const auto& piece) { return m_sets[other].contains(piece); });
    }
    /// Trays since one with any of its pieces, or until one.
    long away(std::size_t at, std::ptrdiff_t direction) const
    {
        long steps = 1;
        for (std::size_t other = at + static_cast<std::size_t>(direction); other < size();
             other += static_cast<std::size_t>(direction), ++steps)
            if (sharedWith(at, other) > 0) return steps;
        return 0;
    }
    /// Trays with this piece in this slot, for each slot.
    std::vector<long> inItsSlot(std::size_t at) const
    {
        std::vector<long> counts;
        for (const auto& lies : m_slots[at]) counts.push_back(m_inSlots.at(lies));
        return counts;
    }
    /// The pieces that lie most often in the slot that they have here; with the sign -1, least often. None where all do.
    std::string oftenInItsSlot(std::size_t at, long sign) const
    {
        const auto counts = inItsSlot(at);
        const auto [fewest, most] = std::ranges::minmax(counts);
        std::string pieces;
        for (std::size_t slot = 0; fewest < most && slot < counts.size(); ++slot)
            if (counts[slot] == (sign > 0 ? most : fewest)) pieces += (pieces.empty() ? "" : " ") + m_slots[at][slot].first;
        return pieces;
    }
    bool isBetweenEqual(std::size_t at) const { return at > 0 && at + 1 < size() && m_sets[at - 1] == m_sets[at + 1]; }

private:
    std::vector<long> traysOfEach(std::size_t at, std::size_t begin, std::size_t end) const
    {
        std::vector<long> counts;
        for (const auto& piece : m_sets[at]) counts.push_back(traysOf(piece, begin, end));
        return counts;
    }

    using PieceInSlot = std::pair<std::string, std::size_t>;

    std::vector<PieceSet> m_sets;
    std::vector<std::vector<PieceInSlot>> m_slots;
    std::map<PieceInSlot, long> m_inSlots;  ///< trays
};

struct TrayCount {
    const char* name;
    std::function<long(const TrayList& list, std::size_t at)> of;
};

const std::vector<TrayCount>& kindsOfCounts()
{
    static const std::vector<TrayCount> counts{
        {"trays with its rarest piece", [](auto& list, auto at) { return list.rarest(at); }},
        {"trays with its commonest piece", [](auto& list, auto at) { return list.commonest(at); }},
        {"earlier trays with a piece", [](auto& list, auto at) { return list.before(at); }},
        {"later trays with a piece", [](auto& list, auto at) { return list.after(at); }},
        {"trays with the same pieces", [](auto& list, auto at) { return list.sameSets(at, list.size()); }},
        {"earlier trays with the same pieces", [](auto& list, auto at) { return list.sameSets(at, at); }},
        {"pieces that lay there before", [](auto& list, auto at) { return list.sharedWith(at, at - 1); }},
        {"pieces that stay for the next", [](auto& list, auto at) { return list.sharedWith(at, at + 1); }},
        {"trays since a piece lay there", [](auto& list, auto at) { return list.away(at, -1); }},
        {"trays until a piece comes again", [](auto& list, auto at) { return list.away(at, 1); }},
        {"between two equal trays", [](auto& list, auto at) { return long{list.isBetweenEqual(at)}; }},
        {"trays with a piece in its slot, most", [](auto& list, auto at) { return std::ranges::max(list.inItsSlot(at)); }},
        {"trays with a piece in its slot, fewest", [](auto& list, auto at) { return std::ranges::min(list.inItsSlot(at)); }},
        {"place in the list", [](auto&, auto at) { return static_cast<long>(at) + 1; }},
        {"trials from the end", [](auto& list, auto at) { return static_cast<long>(list.size() - at); }},
    };
    return counts;
}

/// How much likelier each value is for an anchor, from the lists of one parity of the slots.
class Likelihoods {
public:
    void learn(const std::string& value, bool isAnchor)
    {
        ++(isAnchor ? m_anchors : m_others)[value];
        ++(isAnchor ? m_allAnchors : m_allOthers);
    }

    double score(const std::string& value) const
    {
        const auto share = [&](const std::map<std::string, double>& counts, double all) {
            const auto found = counts.find(value);
            return ((found == counts.end() ? 0.0 : found->second) + 0.5) / (all + 1);
        };
        return std::log(share(m_anchors, m_allAnchors) / share(m_others, m_allOthers));
    }

private:
    std::map<std::string, double> m_anchors, m_others;
    double m_allAnchors = 0, m_allOthers = 0;
};

/// The lists of phases with anchors, each without its first block.
std::vector<TrialNumbers> listsWithAnchors(const SeenStudy& study)
{
    std::vector<TrialNumbers> lists;
    const auto behind = behindTheFirstBlock(study);
    for (TrialNumbers list : listsIn(study)) {
        const auto& phase = study.protocol.phases.at(static_cast<std::size_t>(study.trials[list.front()].phase));
        if (phase.anchors.presentations() == 0) continue;
        std::erase_if(list, [&](std::size_t trial) { return !behind[trial]; });
        lists.push_back(std::move(list));
    }
    return lists;
}

void nameLikeliest(const TrialNumbers& list, const Feature& feature, const Likelihoods& likelihoods, const Truth& truth,
                   protocols::Random& random, Tally& tally)
{
    const auto isAnchor = [&](std::size_t trial) { return !truth.trials[trial].anchor.empty(); };
    const auto scoreOf = [&](std::size_t trial) { return likelihoods.score(feature.values[trial]); };
    const auto anchors = std::ranges::count_if(list, isAnchor);
    const double chance = static_cast<double>(anchors) / static_cast<double>(list.size());
    TrialNumbers likeliest = list;
    random.shuffle(likeliest);
    std::ranges::stable_sort(likeliest, std::greater<>(), scoreOf);
    if (!(scoreOf(likeliest.front()) > scoreOf(likeliest.back()))) return;
    likeliest.resize(static_cast<std::size_t>(anchors));
    for (const std::size_t trial : likeliest) tally.take({1, 0}, isAnchor(trial) ? 0 : 1, chance);
}

}  // namespace

std::vector<Feature> trayCounts(const SeenStudy& study)
{
    const auto& kinds = kindsOfCounts();
    std::vector<Feature> features;
    for (const TrayCount& count : kinds)
        features.push_back({std::string("trays: ") + count.name, std::vector<std::string>(study.trials.size())});
    for (const char* often : {"most", "least"})
        features.push_back(
            {std::string("trays: piece ") + often + " often in its slot", std::vector<std::string>(study.trials.size())});
    for (const TrialNumbers& numbers : listsIn(study)) {
        const TrayList list(study, numbers);
        for (std::size_t at = 0; at < numbers.size(); ++at) {
            for (std::size_t kind = 0; kind < kinds.size(); ++kind)
                features[kind].values[numbers[at]] = std::to_string(kinds[kind].of(list, at));
            features[kinds.size()].values[numbers[at]] = list.oftenInItsSlot(at, 1);
            features[kinds.size() + 1].values[numbers[at]] = list.oftenInItsSlot(at, -1);
        }
    }
    return features;
}

std::vector<Guess> guessesOfAnchors(const SeenStudy& study, const Truth& truth)
{
    std::vector<Guess> guesses;
    const auto lists = listsWithAnchors(study);
    protocols::Random random(1);
    for (const Feature& feature : trayCounts(study)) {
        Tally tally("likeliest trials: learned anchor", feature.name, "anchor");
        for (const int serves : {0, 1}) {
            Likelihoods likelihoods;
            for (const TrialNumbers& list : lists)
                for (const std::size_t trial : list)
                    if (study.trials[trial].slot % 2 != serves)
                        likelihoods.learn(feature.values[trial], !truth.trials[trial].anchor.empty());
            tally.beginPart();
            for (const TrialNumbers& list : lists)
                if (study.trials[list.front()].slot % 2 == serves)
                    nameLikeliest(list, feature, likelihoods, truth, random, tally);
        }
        tally.addTo(guesses);
    }
    return guesses;
}

}  // namespace study::leaks
