#include "protocols/orders/foil_sets.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "protocols/orders/annealing.h"

namespace protocols {

namespace {

/// Up to this number all sets of a true fabric are listed; if there are more, this number is drawn.
constexpr std::int64_t longestPool = 5000;

using Pools = std::vector<std::vector<FoilSet>>;                  // [true fabric][set]
using Deal = std::vector<std::vector<std::vector<std::size_t>>>;  // [participant][true fabric][presentation] -> set
using TimesTrue = std::vector<std::vector<int>>;                  // [participant][fabric]

std::vector<int> othersThan(int trueFabric, int fabrics)
{
    std::vector<int> others;
    for (int fabric = 0; fabric < fabrics; ++fabric)
        if (fabric != trueFabric) others.push_back(fabric);
    return others;
}

std::vector<FoilSet> drawnFoilSets(int fabrics, int trueFabric, int count, Random& random)
{
    std::set<FoilSet> sets;
    std::vector<int> others = othersThan(trueFabric, fabrics);
    while (static_cast<std::int64_t>(sets.size()) < longestPool) {
        random.shuffle(others);
        FoilSet set(others.begin(), others.begin() + count);
        std::ranges::sort(set);
        sets.insert(std::move(set));
    }
    return {sets.begin(), sets.end()};
}

Pools poolsOf(int fabrics, int foils, Random& random)
{
    const bool listed = combinations(fabrics - 1, foils, longestPool + 1) <= longestPool;
    Pools pools;
    for (int fabric = 0; fabric < fabrics; ++fabric)
        pools.push_back(listed ? allFoilSets(fabrics, fabric, foils) : drawnFoilSets(fabrics, fabric, foils, random));
    return pools;
}

/// Each participant takes the least used sets, so that the numbers of uses differ by at most one.
Deal leastUsedFirst(const TimesTrue& timesTrue, const Pools& pools, Random& random)
{
    Deal deal(timesTrue.size(), std::vector<std::vector<std::size_t>>(pools.size()));
    for (std::size_t fabric = 0; fabric < pools.size(); ++fabric) {
        std::vector<int> uses(pools[fabric].size(), 0);
        std::vector<std::size_t> sets(pools[fabric].size());
        std::iota(sets.begin(), sets.end(), std::size_t{0});
        for (std::size_t participant = 0; participant < deal.size(); ++participant) {
            auto& taken = deal[participant][fabric];
            const auto times = static_cast<std::size_t>(timesTrue[participant][fabric]);
            while (taken.size() < times) {
                random.shuffle(sets);
                std::ranges::stable_sort(sets, [&](std::size_t a, std::size_t b) { return uses[a] < uses[b]; });
                const std::size_t wanted = std::min(times - taken.size(), sets.size());
                for (std::size_t i = 0; i < wanted; ++i) taken.push_back(sets[i]);
                for (std::size_t i = 0; i < wanted; ++i) ++uses[sets[i]];
            }
        }
    }
    return deal;
}

/// State of the search: the deal with its counts. Foils are not balanced within participant x true fabric: with that rule, too,
/// few assignments of true fabrics would fit the trays, and a search among them would find many of the true ones. A move lets two
/// participants exchange a set, or one participant take a set that is used once less. Both keep the numbers of uses even.
class FoilSearch {
public:
    FoilSearch(int foils, const Pools& pools, Deal deal)
        : m_fabrics(pools.size()), m_pools(pools), m_deal(std::move(deal)), m_perParticipant(m_deal.size() * m_fabrics)
    {
        for (const auto& pool : pools) m_uses.emplace_back(pool.size(), 0);
        for (std::size_t participant = 0; participant < m_deal.size(); ++participant) {
            std::int64_t presentations = 0;
            for (std::size_t fabric = 0; fabric < m_fabrics; ++fabric)
                for (const std::size_t set : m_deal[participant][fabric]) {
                    ++presentations;
                    ++m_uses[fabric][set];
                    m_excess += m_perParticipant.add(participant * m_fabrics + fabric);
                    count(participant, fabric, set, true);
                }
            m_excess -= leastSquares(presentations * (foils + 1), static_cast<std::int64_t>(m_fabrics));
        }
    }

    std::int64_t excess() const { return m_excess; }
    const Deal& deal() const { return m_deal; }

    std::int64_t applyRandomMove(Random& random)
    {
        m_fabric = random.below(m_fabrics);
        m_giver = random.below(m_deal.size());
        m_taker = random.below(m_deal.size());
        m_givenAt = random.below(m_deal[m_giver][m_fabric].size());
        m_given = m_deal[m_giver][m_fabric][m_givenAt];
        m_moved = m_giver == m_taker ? chooseUnused(random) : chooseFromTaker(random);
        if (!m_moved) return 0;
        const std::int64_t before = m_excess;
        replace(m_given, m_taken);
        return m_excess - before;
    }

    void undoMove()
    {
        if (m_moved) replace(m_taken, m_given);
    }

private:
    std::int64_t timesDealt(std::size_t participant, std::size_t set) const
    {
        return std::ranges::count(m_deal[participant][m_fabric], set);
    }

    bool chooseUnused(Random& random)
    {
        m_taken = random.below(m_pools[m_fabric].size());
        return m_uses[m_fabric][m_taken] + 1 == m_uses[m_fabric][m_given] &&
               timesDealt(m_giver, m_taken) < timesDealt(m_giver, m_given);
    }

    bool chooseFromTaker(Random& random)
    {
        m_takenAt = random.below(m_deal[m_taker][m_fabric].size());
        m_taken = m_deal[m_taker][m_fabric][m_takenAt];
        return m_taken != m_given && timesDealt(m_giver, m_taken) < timesDealt(m_giver, m_given) &&
               timesDealt(m_taker, m_given) < timesDealt(m_taker, m_taken);
    }

    /// Replaces the giver's set `from` by `to`, and the taker's `to` by `from`.
    void replace(std::size_t from, std::size_t to)
    {
        exchange(m_giver, m_givenAt, from, to);
        if (m_giver != m_taker) exchange(m_taker, m_takenAt, to, from);
    }

    void exchange(std::size_t participant, std::size_t at, std::size_t from, std::size_t to)
    {
        count(participant, m_fabric, from, false);
        count(participant, m_fabric, to, true);
        --m_uses[m_fabric][from];
        ++m_uses[m_fabric][to];
        m_deal[participant][m_fabric][at] = to;
    }

    void count(std::size_t participant, std::size_t fabric, std::size_t set, bool adding)
    {
        for (const int foil : m_pools[fabric][set]) {
            const std::size_t own = participant * m_fabrics + static_cast<std::size_t>(foil);
            m_excess += adding ? m_perParticipant.add(own) : m_perParticipant.remove(own);
        }
    }

    std::size_t m_fabrics;
    const Pools& m_pools;
    Deal m_deal;
    std::vector<std::vector<int>> m_uses;  ///< [true fabric][set], over the study
    SquaredCounts m_perParticipant;        ///< [participant][fabric on the tray]
    std::int64_t m_excess = 0;
    std::size_t m_fabric = 0, m_giver = 0, m_taker = 0, m_givenAt = 0, m_takenAt = 0, m_given = 0, m_taken = 0;
    bool m_moved = false;
};

}  // namespace

std::int64_t combinations(std::int64_t n, std::int64_t k, std::int64_t limit)
{
    std::int64_t result = 1;
    for (std::int64_t i = 1; i <= std::min(k, n - k); ++i) {
        result = result * (n - i + 1) / i;
        if (result >= limit) return limit;
    }
    return result;
}

std::vector<FoilSet> allFoilSets(int fabrics, int trueFabric, int count)
{
    const std::vector<int> others = othersThan(trueFabric, fabrics);
    std::vector<FoilSet> sets;
    std::vector<bool> chosen(others.size(), false);
    std::fill_n(chosen.begin(), count, true);
    do {
        FoilSet set;
        for (std::size_t i = 0; i < others.size(); ++i)
            if (chosen[i]) set.push_back(others[i]);
        sets.push_back(std::move(set));
    } while (std::prev_permutation(chosen.begin(), chosen.end()));
    return sets;
}

std::vector<std::vector<std::vector<FoilSet>>> drawFoilSets(const TimesTrue& timesTrue, int foils, Random& random)
{
    const Pools pools = poolsOf(static_cast<int>(timesTrue.front().size()), foils, random);
    FoilSearch search(foils, pools, leastUsedFirst(timesTrue, pools, random));
    std::int64_t sets = 0;
    for (const auto& participant : timesTrue)
        for (const int times : participant) sets += times;
    annealAgain(search, random, {.moves = std::clamp<std::int64_t>(sets * 2000, 50'000, 2'000'000), .hot = 4});
    std::vector<std::vector<std::vector<FoilSet>>> result;
    for (const auto& participant : search.deal()) {
        auto& perFabric = result.emplace_back();
        for (std::size_t fabric = 0; fabric < pools.size(); ++fabric) {
            auto& own = perFabric.emplace_back();
            for (const std::size_t set : participant[fabric]) own.push_back(pools[fabric][set]);
            random.shuffle(own);
        }
    }
    return result;
}

}  // namespace protocols
