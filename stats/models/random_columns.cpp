#include "stats/models/random_columns.h"

#include <algorithm>
#include <numeric>

namespace stats {
namespace {

constexpr std::size_t mostTermsTried = 6;  // in every division; of more terms, only the largest forms blocks

/// Sets that grow together (union by index, with path halving).
class ConnectedColumns {
public:
    explicit ConnectedColumns(std::size_t count) : m_parent(count) { std::iota(m_parent.begin(), m_parent.end(), 0U); }

    std::uint32_t rootOf(std::uint32_t column)
    {
        while (m_parent[column] != column) column = m_parent[column] = m_parent[m_parent[column]];
        return column;
    }
    void connect(std::uint32_t a, std::uint32_t b)
    {
        a = rootOf(a);
        b = rootOf(b);
        m_parent[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> m_parent;
};

}  // namespace

RandomColumns::RandomColumns(std::span<const Factor> groups, std::size_t rows)
    : m_terms(groups.size()), m_rows(rows), m_columns(rows * groups.size())
{
    // A block of a participant and its participant:condition levels stays sparse where the participant comes last.
    std::vector<std::size_t> order(m_terms);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return groups[a].levels.size() > groups[b].levels.size(); });
    for (const std::size_t t : order) {
        const std::size_t first = m_termOf.size();
        m_termOf.insert(m_termOf.end(), groups[t].levels.size(), static_cast<std::uint32_t>(t));
        for (std::size_t i = 0; i < m_rows; ++i) m_columns[i * m_terms + t] = static_cast<std::uint32_t>(first + groups[t].of[i]);
    }
    Division best;
    for (std::size_t mask = 0; mask < (std::size_t{1} << std::min(m_terms, mostTermsTried)); ++mask) {
        std::vector<bool> inBorder(m_terms, m_terms > mostTermsTried);
        if (m_terms > mostTermsTried)
            inBorder[order.front()] = false;
        else
            for (std::size_t t = 0; t < m_terms; ++t) inBorder[t] = (mask >> t & 1U) != 0;
        Division division = dividedBy(inBorder);
        if (mask == 0 || division.cost < best.cost) best = std::move(division);
        if (m_terms > mostTermsTried) break;
    }
    m_cost = best.cost;
    m_shape = BorderedShape(best.blockOf);
}

std::vector<std::uint32_t> RandomColumns::rowsByBlock() const
{
    std::vector<std::uint32_t> blockOf(m_rows);
    for (std::size_t i = 0; i < m_rows; ++i)
        for (std::size_t t = 0; t < m_terms; ++t)
            if (const std::uint32_t block = m_shape.blockOf(of(i)[t]); block != BorderedShape::inBorder) blockOf[i] = block;
    std::vector<std::uint32_t> rows(m_rows);
    std::iota(rows.begin(), rows.end(), 0U);
    std::stable_sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) { return blockOf[a] < blockOf[b]; });
    return rows;
}

RandomColumns::Division RandomColumns::dividedBy(const std::vector<bool>& termInBorder) const
{
    ConnectedColumns connected(count());
    for (std::size_t i = 0; i < m_rows; ++i) {
        const std::uint32_t* first = nullptr;
        for (std::size_t t = 0; t < m_terms; ++t) {
            if (termInBorder[t]) continue;
            const std::uint32_t* const column = of(i) + t;
            if (first == nullptr) first = column;
            connected.connect(*first, *column);
        }
    }
    Division division;
    std::vector<std::size_t> sizes;
    std::vector<std::uint32_t> blockOfRoot(count(), BorderedShape::inBorder);
    std::size_t border = 0;
    for (std::uint32_t column = 0; column < count(); ++column) {
        if (termInBorder[m_termOf[column]]) {
            division.blockOf.push_back(BorderedShape::inBorder);
            ++border;
            continue;
        }
        std::uint32_t& block = blockOfRoot[connected.rootOf(column)];
        if (block == BorderedShape::inBorder) {
            block = static_cast<std::uint32_t>(sizes.size());
            sizes.push_back(0);
        }
        ++sizes[block];
        division.blockOf.push_back(block);
    }
    division.cost = factorCost(sizes, border);
    return division;
}

}  // namespace stats
