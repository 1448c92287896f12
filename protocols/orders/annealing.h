// Simulated annealing with integers only, so that a search ends in the same state on every machine. A search has three members:
// excess() returns its cost minus the lowest possible cost (0: nothing left to gain); applyRandomMove(random) changes the state
// and returns the change of cost; undoMove() reverses exactly that change.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "protocols/random.h"

namespace protocols {

struct AnnealingSchedule {
    std::int64_t moves = 0;  ///< at most; the search ends earlier when the excess is 0
    std::int64_t hot = 8;    ///< increase of cost that is accepted with probability 1/2 at the start
};

/// The temperature falls linearly to 0 over the first 7/8 of the moves. An increase of cost by k temperatures is accepted with
/// probability 2^-k, because the number of trailing zeros of a random word has that distribution.
template <class Search>
void anneal(Search& search, Random& random, const AnnealingSchedule& schedule)
{
    constexpr std::int64_t fine = 1024;  // the temperature is counted in 1/1024 of a cost unit
    const std::int64_t cooling = std::max<std::int64_t>(1, schedule.moves - schedule.moves / 8);
    for (std::int64_t move = 0; move < schedule.moves && search.excess() > 0; ++move) {
        const std::int64_t temperature = schedule.hot * fine * std::max<std::int64_t>(0, cooling - move) / cooling;
        const std::int64_t change = search.applyRandomMove(random);
        if (change <= 0) continue;
        const std::int64_t zeros = std::countr_zero(random.next() | (std::uint64_t{1} << 62));
        if (change * fine > temperature * zeros) search.undoMove();
    }
}

/// Anneals up to four times, as long as the excess is not 0.
template <class Search>
void annealAgain(Search& search, Random& random, const AnnealingSchedule& schedule)
{
    for (int round = 0; round < 4 && search.excess() > 0; ++round) anneal(search, random, schedule);
}

/// Counts with the change of their sum of squares. The sum is least when the counts are as equal as possible.
class SquaredCounts {
public:
    explicit SquaredCounts(std::size_t cells) : m_counts(cells, 0) {}

    /// Both return the change of the sum of squares.
    std::int64_t add(std::size_t cell) { return 2 * std::int64_t{m_counts[cell]++} + 1; }
    std::int64_t remove(std::size_t cell) { return -(2 * std::int64_t{--m_counts[cell]} + 1); }
    int operator[](std::size_t cell) const { return m_counts[cell]; }
    std::size_t size() const { return m_counts.size(); }

private:
    std::vector<int> m_counts;
};

/// The least sum of squares of `cells` counts that add up to `total`.
inline std::int64_t leastSquares(std::int64_t total, std::int64_t cells)
{
    if (cells == 0) return 0;
    const std::int64_t low = total / cells;
    const std::int64_t higher = total % cells;
    return higher * (low + 1) * (low + 1) + (cells - higher) * low * low;
}

}  // namespace protocols
