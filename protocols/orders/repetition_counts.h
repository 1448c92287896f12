// What repeated presentations show while a search exchanges what their originals show: conditions are repeated equally often, and
// a repetition has another condition than its neighbours.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "protocols/orders/annealing.h"
#include "protocols/orders/running_orders.h"

namespace protocols {

/// A repetition. All places are those of the list without additional presentations; a neighbour that is a repetition itself
/// stands for its original.
struct Copy {
    std::size_t original = 0;
    std::vector<std::size_t> neighbours;
};
/// [participant]
using Copies = std::vector<std::vector<Copy>>;

class RepetitionCounts {
public:
    RepetitionCounts(const Copies& copies, const StudySize& size, std::size_t length)
        : m_copies(copies),
          m_fabrics(static_cast<std::size_t>(size.fabrics)),
          m_hasClashes(!mayRepeat(size.labels)),
          m_ofLabel(static_cast<std::size_t>(size.labels)),
          m_ofRendering(m_ofLabel.size() * m_fabrics)
    {
        for (const auto& own : copies) {
            auto& at = m_at.emplace_back(own.empty() ? 0 : length);
            for (std::size_t copy = 0; copy < own.size(); ++copy) {
                at[own[copy].original].push_back(copy);
                for (const std::size_t neighbour : own[copy].neighbours)  // both may be one place, or the original
                    if (std::ranges::find(at[neighbour], copy) == at[neighbour].end()) at[neighbour].push_back(copy);
            }
        }
    }

    std::int64_t least() const
    {
        std::int64_t all = 0;
        for (const auto& own : m_copies) all += static_cast<std::int64_t>(own.size());
        return costOfLabel * leastSquares(all, static_cast<std::int64_t>(m_ofLabel.size())) +
               leastSquares(all, static_cast<std::int64_t>(m_ofRendering.size()));
    }

    /// Counts every repetition of a participant.
    std::int64_t addAll(std::size_t participant, const std::vector<Rendering>& order)
    {
        std::int64_t change = 0;
        if (m_copies.empty()) return change;
        for (const Copy& copy : m_copies[participant]) change += count(copy, order, true);
        return change;
    }

    /// Counts the repetitions that the two places concern, each once. Returns the change of cost.
    std::int64_t around(std::size_t participant, const std::vector<Rendering>& order, std::size_t first, std::size_t second,
                        bool adding)
    {
        std::int64_t change = 0;
        if (m_copies.empty() || m_copies[participant].empty()) return change;
        const auto &ofFirst = m_at[participant][first], &ofSecond = m_at[participant][second];
        for (const std::size_t copy : ofFirst) change += count(m_copies[participant][copy], order, adding);
        for (const std::size_t copy : ofSecond)
            if (std::ranges::find(ofFirst, copy) == ofFirst.end()) change += count(m_copies[participant][copy], order, adding);
        return change;
    }

private:
    static constexpr std::int64_t costOfLabel = 8, costOfClash = 160;

    static std::int64_t change(SquaredCounts& counts, std::size_t cell, bool adding)
    {
        return adding ? counts.add(cell) : counts.remove(cell);
    }

    std::int64_t count(const Copy& copy, const std::vector<Rendering>& order, bool adding)
    {
        const Rendering& shown = order[copy.original];
        const auto label = static_cast<std::size_t>(shown.label);
        std::int64_t sum = costOfLabel * change(m_ofLabel, label, adding) +
                           change(m_ofRendering, label * m_fabrics + static_cast<std::size_t>(shown.fabric), adding);
        if (m_hasClashes)
            for (const std::size_t neighbour : copy.neighbours)
                if (order[neighbour].label == shown.label) sum += adding ? costOfClash : -costOfClash;
        return sum;
    }

    Copies m_copies;
    std::size_t m_fabrics;
    bool m_hasClashes;
    SquaredCounts m_ofLabel, m_ofRendering;
    std::vector<std::vector<std::vector<std::size_t>>> m_at;  ///< [participant][place]: copies that it concerns
};

}  // namespace protocols
