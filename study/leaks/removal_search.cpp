#include "study/leaks/removal_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "protocols/condition.h"
#include "protocols/orders/running_orders.h"
#include "study/leaks/questions.h"
#include "study/leaks/tally.h"

namespace study::leaks {

namespace {

/// What is taken out, with the unevenness of what stays. A move takes out another presentation of one piece.
class Removal {
public:
    Removal(const PieceLists& lists, int kept, protocols::Random& random) : m_lists(lists)
    {
        int most = 0;
        for (const auto& list : lists)
            for (const int piece : list) most = std::max(most, piece);
        m_fabrics = static_cast<std::size_t>(most) + 1;
        m_pairs.resize(m_fabrics * m_fabrics);
        for (std::size_t list = 0; list < lists.size(); ++list) {
            m_stretches.resize(std::max(m_stretches.size(), lists[list].size() + m_fabrics) / m_fabrics * m_fabrics + m_fabrics);
            m_isOut.emplace_back(lists[list].size());
            for (std::size_t piece = 0; piece < m_fabrics; ++piece) drawFirst(list, piece, kept, random);
        }
        for (std::size_t list = 0; list < lists.size(); ++list) count(list, 1);
    }

    bool canMove() const { return !m_groups.empty(); }
    double cost() const { return m_cost; }
    bool isOut(std::size_t list, std::size_t at) const { return m_isOut[list][at]; }

    void propose(protocols::Random& random)
    {
        auto& group = m_groups[random.below(m_groups.size())];
        m_list = group.list;
        m_before = group.places[random.below(group.out)];
        m_after = group.places[group.out + random.below(group.places.size() - group.out)];
        m_moved = &group;
        exchange();
    }

    void takeBack()
    {
        std::swap(m_before, m_after);
        exchange();
    }

private:
    /// The places of one piece in a list; those that are out come first.
    struct Group {
        std::size_t list = 0, out = 0;
        std::vector<std::size_t> places;
    };

    void drawFirst(std::size_t list, std::size_t piece, int kept, protocols::Random& random)
    {
        Group group{list, 0, {}};
        for (std::size_t at = 0; at < m_lists[list].size(); ++at)
            if (m_lists[list][at] == static_cast<int>(piece)) group.places.push_back(at);
        const auto stay = std::min(group.places.size(), static_cast<std::size_t>(kept));
        group.out = group.places.size() - stay;
        random.shuffle(group.places);
        for (std::size_t i = 0; i < group.out; ++i) m_isOut[list][group.places[i]] = true;
        if (group.out > 0 && stay > 0) m_groups.push_back(std::move(group));
    }

    void exchange()
    {
        count(m_list, -1);
        m_isOut[m_list][m_before] = false;
        m_isOut[m_list][m_after] = true;
        std::swap(*std::ranges::find(m_moved->places, m_before), *std::ranges::find(m_moved->places, m_after));
        count(m_list, 1);
    }

    void tally(std::vector<int>& counts, std::size_t cell, int sign, double weight)
    {
        const int before = counts[cell];
        counts[cell] += sign;
        m_cost += weight * (counts[cell] * counts[cell] - before * before);
    }

    void count(std::size_t list, int sign)
    {
        constexpr double costOfRepeat = 400, costOfPair = 8, costOfStretch = 1;
        std::size_t last = m_fabrics, staying = 0;
        for (std::size_t at = 0; at < m_lists[list].size(); ++at) {
            if (m_isOut[list][at]) continue;
            const auto piece = static_cast<std::size_t>(m_lists[list][at]);
            if (last == piece && !protocols::mayRepeat(static_cast<int>(m_fabrics)))
                m_cost += sign * costOfRepeat;
            else if (last < m_fabrics)
                tally(m_pairs, last * m_fabrics + piece, sign, costOfPair);
            tally(m_stretches, staying / m_fabrics * m_fabrics + piece, sign, costOfStretch);
            last = piece;
            ++staying;
        }
    }

    const PieceLists& m_lists;
    std::size_t m_fabrics = 0;
    std::vector<std::vector<bool>> m_isOut;
    std::vector<Group> m_groups;
    std::vector<int> m_pairs, m_stretches;
    double m_cost = 0;
    std::size_t m_list = 0, m_before = 0, m_after = 0;
    Group* m_moved = nullptr;
};

/// The lists of one phase, under one instruction or none.
struct ListsOfPhase {
    PieceLists pieces;
    std::vector<std::vector<std::size_t>> trials;  ///< numbers in SeenStudy
};

std::map<std::pair<int, std::string>, ListsOfPhase> listsWithOthers(const SeenStudy& study)
{
    std::map<std::pair<int, std::string>, ListsOfPhase> phases;
    const SeenTrial* before = nullptr;
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        const SeenTrial& trial = study.trials[i];
        const auto& phase = study.protocol.phases.at(static_cast<std::size_t>(trial.phase));
        if (trial.tray.size() != 1 || phase.catchTrials + phase.anchors.presentations() == 0) continue;
        auto& lists = phases[{trial.phase, trial.instruction}];
        if (before == nullptr || !trial.isInListOf(*before)) {
            lists.pieces.emplace_back();
            lists.trials.emplace_back();
        }
        before = &trial;
        lists.pieces.back().push_back(
            static_cast<int>(std::ranges::find(study.fabrics, trial.tray.front()) - study.fabrics.begin()));
        lists.trials.back().push_back(i);
    }
    return phases;
}

bool isAdditional(const Truth::Shown& shown)
{
    return !shown.anchor.empty() || shown.condition == protocols::catchTrialId().value;
}

/// The presentations of one piece of a list that were taken out most often, as many as are additional. `places`: those that may
/// be.
void nameRemoved(std::vector<std::size_t> places, const std::vector<double>& removed, const std::vector<std::size_t>& trials,
                 const Truth& truth, Tally& tally)
{
    const auto isHit = [&](std::size_t at) { return isAdditional(truth.trials[trials[at]]); };
    const auto count = static_cast<std::size_t>(std::ranges::count_if(places, isHit));
    if (count == 0 || count == places.size()) return;
    const double chance = static_cast<double>(count) / static_cast<double>(places.size());
    std::ranges::stable_sort(places, std::greater<>(), [&](std::size_t at) { return removed[at]; });
    places.resize(count);
    for (const std::size_t at : places) tally.take({1, 0}, isHit(at) ? 0 : 1, chance);
}

}  // namespace

std::vector<std::vector<double>> removedBySearch(const PieceLists& lists, int kept, std::int64_t moves, protocols::Random& random)
{
    constexpr int searches = 4;
    constexpr double hot = 60, cold = 2;
    std::vector<std::vector<double>> removed;
    for (const auto& list : lists) removed.emplace_back(list.size());
    for (int search = 0; search < searches; ++search) {
        Removal removal(lists, kept, random);
        for (std::int64_t move = 0; move < moves && removal.canMove(); ++move) {
            const double temperature = hot * std::pow(cold / hot, static_cast<double>(move) / static_cast<double>(moves));
            const double before = removal.cost();
            removal.propose(random);
            const double change = removal.cost() - before;
            if (change > 0 && random.uniform() >= std::exp(-change / temperature)) removal.takeBack();
            if (move * 5 < moves * 4 || move % 20 != 0) continue;
            for (std::size_t list = 0; list < lists.size(); ++list)
                for (std::size_t at = 0; at < lists[list].size(); ++at) removed[list][at] += removal.isOut(list, at);
        }
    }
    return removed;
}

std::vector<Guess> guessesOfRemovals(const SeenStudy& study, const Truth& truth)
{
    constexpr std::int64_t movesOfEach = 20'000, mostMoves = 200'000;
    const int kept = static_cast<int>(study.protocol.conditions.size());
    const auto behind = behindTheFirstBlock(study);
    std::vector<Guess> guesses;
    Tally tally("removals that leave even orders", "the pieces on the trays", "catch or anchor");
    for (const auto& [phase, lists] : listsWithOthers(study)) {
        protocols::Random random(static_cast<std::uint64_t>(phase.first) + 1);
        const auto moves = std::min(mostMoves, movesOfEach * static_cast<std::int64_t>(lists.pieces.size()));
        const auto removed = removedBySearch(lists.pieces, kept, moves, random);
        const bool hasRepetitions = study.protocol.phases.at(static_cast<std::size_t>(phase.first)).anchors.repeated > 0;
        for (std::size_t list = 0; list < lists.pieces.size(); ++list)
            for (int piece = 0; piece < static_cast<int>(study.fabrics.size()); ++piece) {
                std::vector<std::size_t> places;
                for (std::size_t at = 1; at < lists.pieces[list].size(); ++at)
                    if (lists.pieces[list][at] == piece && (!hasRepetitions || behind[lists.trials[list][at]]))
                        places.push_back(at);
                nameRemoved(std::move(places), removed[list], lists.trials[list], truth, tally);
            }
    }
    tally.addTo(guesses);
    return guesses;
}

}  // namespace study::leaks
