#include "protocols/orders/running_orders.h"

#include <array>
#include <utility>

#include "protocols/orders/annealing.h"

namespace protocols {

namespace {

using Orders = std::vector<std::vector<Rendering>>;

// Even pairs count more than even stretches.
constexpr std::int64_t pairWeight = 8;

Orders shuffledOrders(const StudySize& size, Random& random)
{
    std::vector<Rendering> all;
    for (int label = 0; label < size.labels; ++label)
        for (int fabric = 0; fabric < size.fabrics; ++fabric) all.push_back({label, fabric});
    Orders orders(static_cast<std::size_t>(size.participants), all);
    for (auto& order : orders) random.shuffle(order);
    return orders;
}

std::int64_t transitionsOf(const StudySize& size)
{
    return std::int64_t{size.participants} * (std::int64_t{size.labels} * size.fabrics - 1);
}

/// Cost of an immediate repeat: more than any unevenness that avoiding it can cause.
std::int64_t repeatPenalty(const StudySize& size, int kinds)
{
    if (mayRepeat(kinds)) return 0;
    return pairWeight * (2 * transitionsOf(size) / pairKinds(kinds) + 20);
}

std::int64_t leastPairCost(const StudySize& size, FabricOrder order)
{
    const auto pairs = [&](int kinds) { return leastSquares(transitionsOf(size), pairKinds(kinds)); };
    return pairWeight * (pairs(size.labels) + (order == FabricOrder::Even ? pairs(size.fabrics) : 0));
}

/// The cost when each participant has each label once in each stretch of labels, and each fabric once in each of fabrics.
std::int64_t leastStretchCost(const StudySize& size, FabricOrder order)
{
    return std::int64_t{order == FabricOrder::Even ? 2 : 1} * size.labels * size.fabrics * size.participants * size.participants;
}

/// State of the search: the orders with their counts, and a swap of two positions as its move.
class OrderSearch {
public:
    OrderSearch(const StudySize& size, FabricOrder fabrics, Orders orders)
        : m_size(size),
          m_fabricsAreEven(fabrics == FabricOrder::Even),
          m_orders(std::move(orders)),
          m_labelPairs(square(size.labels)),
          m_fabricPairs(square(size.fabrics)),
          m_labelStretches(static_cast<std::size_t>(size.labels) * static_cast<std::size_t>(size.fabrics)),
          m_fabricStretches(static_cast<std::size_t>(size.labels) * static_cast<std::size_t>(size.fabrics)),
          m_labelRepeat(repeatPenalty(size, size.labels)),
          m_fabricRepeat(repeatPenalty(size, size.fabrics)),
          m_pairExcess(-leastPairCost(size, fabrics)),
          m_stretchExcess(-leastStretchCost(size, fabrics))
    {
        for (const auto& order : m_orders) {
            for (std::size_t at = 0; at < order.size(); ++at) countPlace(order[at], at, true);
            for (std::size_t at = 0; at + 1 < order.size(); ++at) countTransition(order[at], order[at + 1], true);
        }
    }

    std::int64_t excess() const { return m_pairExcess + m_stretchExcess; }
    bool pairsAreEven() const { return m_pairExcess == 0; }
    const Orders& orders() const { return m_orders; }

    std::int64_t applyRandomMove(Random& random)
    {
        m_participant = random.below(m_orders.size());
        const std::size_t length = m_orders.front().size();
        m_first = random.below(length);
        m_second = random.below(length);
        return swapPlaces();
    }

    void undoMove() { swapPlaces(); }

private:
    static std::size_t square(int n) { return static_cast<std::size_t>(n) * static_cast<std::size_t>(n); }

    std::int64_t swapPlaces()
    {
        if (m_first == m_second) return 0;
        auto& order = m_orders[m_participant];
        const std::int64_t before = excess();
        countAround(order, false);
        std::swap(order[m_first], order[m_second]);
        countAround(order, true);
        return excess() - before;
    }

    /// Counts the two places and their transitions (four at most), each once.
    void countAround(const std::vector<Rendering>& order, bool adding)
    {
        const std::size_t low = std::min(m_first, m_second);
        const std::size_t high = std::max(m_first, m_second);
        countPlace(order[low], low, adding);
        countPlace(order[high], high, adding);
        if (low > 0) countTransition(order[low - 1], order[low], adding);
        countTransition(order[low], order[low + 1], adding);
        if (high - 1 > low) countTransition(order[high - 1], order[high], adding);
        if (high + 1 < order.size()) countTransition(order[high], order[high + 1], adding);
    }

    static std::int64_t count(SquaredCounts& counts, std::size_t cell, bool adding)
    {
        return adding ? counts.add(cell) : counts.remove(cell);
    }

    std::int64_t countPair(SquaredCounts& pairs, std::int64_t repeat, int kinds, int a, int b, bool adding) const
    {
        if (a == b && !mayRepeat(kinds)) return adding ? repeat : -repeat;
        return pairWeight * count(pairs, static_cast<std::size_t>(a * kinds + b), adding);
    }

    void countTransition(const Rendering& from, const Rendering& to, bool adding)
    {
        m_pairExcess += countPair(m_labelPairs, m_labelRepeat, m_size.labels, from.label, to.label, adding);
        const bool isRepeat = from.fabric == to.fabric && !mayRepeat(m_size.fabrics);
        if (m_fabricsAreEven || isRepeat)
            m_pairExcess += countPair(m_fabricPairs, m_fabricRepeat, m_size.fabrics, from.fabric, to.fabric, adding);
    }

    void countPlace(const Rendering& rendering, std::size_t at, bool adding)
    {
        const auto labels = static_cast<std::size_t>(m_size.labels);
        const auto fabrics = static_cast<std::size_t>(m_size.fabrics);
        const std::size_t labelCell = at / labels * labels + static_cast<std::size_t>(rendering.label);
        const std::size_t fabricCell = at / fabrics * fabrics + static_cast<std::size_t>(rendering.fabric);
        m_stretchExcess += count(m_labelStretches, labelCell, adding);
        if (m_fabricsAreEven) m_stretchExcess += count(m_fabricStretches, fabricCell, adding);
    }

    StudySize m_size;
    bool m_fabricsAreEven;
    Orders m_orders;
    SquaredCounts m_labelPairs;
    SquaredCounts m_fabricPairs;
    SquaredCounts m_labelStretches;   ///< [stretch][label]
    SquaredCounts m_fabricStretches;  ///< [stretch][fabric]
    std::int64_t m_labelRepeat;
    std::int64_t m_fabricRepeat;
    std::int64_t m_pairExcess;
    std::int64_t m_stretchExcess;
    std::size_t m_participant = 0;
    std::size_t m_first = 0;
    std::size_t m_second = 0;
};

/// 0, 1, n - 1, 2, n - 2, ...: the differences of neighbours are all different where n is even.
std::vector<int> zigzag(int n)
{
    std::vector<int> order{0};
    for (int low = 1, high = n - 1; low <= high; ++low, --high) {
        order.push_back(low);
        if (low != high) order.push_back(high);
    }
    return order;
}

std::vector<std::vector<int>> williamsDesign(int n)
{
    const std::vector<int> first = zigzag(n);
    std::vector<std::vector<int>> design;
    for (int shift = 0; shift < n; ++shift) {
        auto& row = design.emplace_back();
        for (const int number : first) row.push_back((number + shift) % n);
    }
    // With an odd number only the rows and their mirror images together are balanced.
    if (n % 2 == 1 && n > 1)
        for (int row = 0; row < n; ++row) {
            design.push_back(design[static_cast<std::size_t>(row)]);
            std::ranges::reverse(design.back());
        }
    return design;
}

}  // namespace

Orders drawRunningOrders(const StudySize& size, FabricOrder fabrics, Random& random)
{
    const std::int64_t places = std::int64_t{size.participants} * size.labels * size.fabrics;
    const std::int64_t moves = std::clamp<std::int64_t>(places * 2000, 100'000, 3'000'000);
    const int rounds = places > 20'000 ? 1 : 4;
    Orders best;
    std::int64_t bestExcess = 0;
    for (int round = 0; round < rounds; ++round) {
        OrderSearch search(size, fabrics, shuffledOrders(size, random));
        anneal(search, random, {.moves = moves, .hot = 4});
        if (round == 0 || search.excess() < bestExcess) {
            best = search.orders();
            bestExcess = search.excess();
        }
        // Only a few stretches are still uneven, by one; another round would gain little.
        if (search.pairsAreEven()) return search.orders();
    }
    return best;
}

std::vector<std::vector<int>> drawInstructionOrders(int participants, int instructions, Random& random)
{
    std::vector<std::vector<int>> orders, cycle;
    while (static_cast<int>(orders.size()) < participants) {
        if (cycle.empty()) {
            cycle = williamsDesign(instructions);
            random.shuffle(cycle);
        }
        orders.push_back(cycle.back());
        cycle.pop_back();
    }
    return orders;
}

}  // namespace protocols
