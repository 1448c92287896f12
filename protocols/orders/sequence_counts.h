// Counts of one sequence of kinds (labels or fabrics) over all lists of a search: ordered pairs of neighbours, repeats, and kinds
// per stretch of the list.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/orders/annealing.h"
#include "protocols/orders/running_orders.h"

namespace protocols {

class SequenceCounts {
public:
    SequenceCounts(int kinds, std::size_t lists, std::size_t length)
        : m_kinds(static_cast<std::size_t>(kinds)),
          m_lists(static_cast<std::int64_t>(lists)),
          m_length(static_cast<std::int64_t>(length)),
          m_pairs(m_kinds * m_kinds),
          m_stretches((length / m_kinds + 1) * m_kinds)
    {
        // More than any unevenness that avoiding a repeat can cause.
        if (!mayRepeat(kinds)) m_costOfRepeat = costOfPair * (2 * transitions() / pairKinds(kinds) + 20);
    }

    std::int64_t least() const
    {
        const auto kinds = static_cast<std::int64_t>(m_kinds);
        return costOfPair * leastSquares(transitions(), pairKinds(static_cast<int>(m_kinds))) +
               m_length / kinds * leastSquares(m_lists * kinds, kinds) + leastSquares(m_lists * (m_length % kinds), kinds);
    }

    /// These return the change of cost.
    std::int64_t place(std::size_t at, int kind, bool adding)
    {
        return change(m_stretches, at / m_kinds * m_kinds + static_cast<std::size_t>(kind), adding);
    }
    std::int64_t step(int from, int to, bool adding)
    {
        if (from == to && !mayRepeat(static_cast<int>(m_kinds))) return adding ? m_costOfRepeat : -m_costOfRepeat;
        return costOfPair * change(m_pairs, static_cast<std::size_t>(from) * m_kinds + static_cast<std::size_t>(to), adding);
    }

private:
    static constexpr std::int64_t costOfPair = 8;  // even pairs count more than even stretches

    static std::int64_t change(SquaredCounts& counts, std::size_t cell, bool adding)
    {
        return adding ? counts.add(cell) : counts.remove(cell);
    }

    std::int64_t transitions() const { return m_lists * (m_length - 1); }

    std::size_t m_kinds;
    std::int64_t m_lists, m_length, m_costOfRepeat = 0;
    SquaredCounts m_pairs;      ///< [kind][next kind]
    SquaredCounts m_stretches;  ///< [stretch][kind]
};

}  // namespace protocols
