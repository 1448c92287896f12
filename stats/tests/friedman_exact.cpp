#include "stats/tests/friedman_exact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "stats/kernels/moments.h"
#include "stats/kernels/ranks.h"

namespace stats {
namespace {

constexpr std::size_t mostConditions = 7;
constexpr double mostOrders = 3e7;

/// Doubled rank sums of the conditions in ascending order. All orders of a block are equally likely, so that rank
/// sums which differ only in their order have the same probability.
struct RankSums {
    std::array<std::uint32_t, mostConditions> sum{};
    std::size_t conditions = 0;

    void sort()
    {
        for (std::size_t i = 1; i < conditions; ++i)
            for (std::size_t j = i; j > 0 && sum[j] < sum[j - 1]; --j) std::swap(sum[j], sum[j - 1]);
    }
};

/// Probabilities of all rank sums; the key packs the sums into one whole number.
class RankSumDistribution {
public:
    /// `largest`: upper bound of a rank sum.
    RankSumDistribution(std::size_t conditions, std::size_t largest) : m_conditions(conditions)
    {
        while ((std::size_t{1} << m_bits) <= largest) ++m_bits;
        m_probability[0] = 1;
    }

    bool fits() const { return m_bits * m_conditions <= 64; }
    std::size_t size() const { return m_probability.size(); }

    /// Adds a block, whose ranks come in one of these orders.
    void add(const std::vector<RankSums>& orders)
    {
        std::unordered_map<std::uint64_t, double> after;
        after.reserve(2 * m_probability.size());
        const double share = 1 / static_cast<double>(orders.size());
        for (const auto& [key, probability] : m_probability) {
            const RankSums start = unpacked(key);
            for (const RankSums& order : orders) {
                RankSums sums = start;
                for (std::size_t j = 0; j < m_conditions; ++j) sums.sum[j] += order.sum[j];
                sums.sort();
                after[packed(sums)] += probability * share;
            }
        }
        m_probability.swap(after);
    }

    template <typename Visit>
    void forEach(Visit visit) const
    {
        for (const auto& [key, probability] : m_probability) visit(unpacked(key), probability);
    }

private:
    std::uint64_t packed(const RankSums& sums) const
    {
        std::uint64_t key = 0;
        for (std::size_t j = 0; j < m_conditions; ++j) key = key << m_bits | sums.sum[j];
        return key;
    }

    RankSums unpacked(std::uint64_t key) const
    {
        RankSums sums{{}, m_conditions};
        for (std::size_t j = m_conditions; j-- > 0; key >>= m_bits)
            sums.sum[j] = static_cast<std::uint32_t>(key & ((std::uint64_t{1} << m_bits) - 1));
        return sums;
    }

    std::size_t m_conditions;
    std::size_t m_bits = 1;
    std::unordered_map<std::uint64_t, double> m_probability;
};

/// All different orders of the ascending ranks of a block.
std::vector<RankSums> ordersOf(RankSums ranks)
{
    std::vector<RankSums> orders;
    do orders.push_back(ranks);
    while (std::next_permutation(ranks.sum.begin(), ranks.sum.begin() + static_cast<std::ptrdiff_t>(ranks.conditions)));
    return orders;
}

/// Sum of squared distances from the expected rank sums. For given ties Friedman's statistic is a multiple of it.
long long spreadOf(const RankSums& sums, long long expected)
{
    long long spread = 0;
    for (std::size_t j = 0; j < sums.conditions; ++j) {
        const long long distance = static_cast<long long>(sums.sum[j]) - expected;
        spread += distance * distance;
    }
    return spread;
}

/// The doubled mid-ranks of every block.
std::vector<RankSums> ranksOf(const BlockTable& table)
{
    std::vector<RankSums> all;
    for (std::size_t block = 0; block < table.blocks; ++block) {
        RankSums ranks{{}, table.conditions};
        const auto doubled = midRanks<double>(withoutRounding(table.row(block))).doubled;
        std::copy(doubled.begin(), doubled.end(), ranks.sum.begin());
        all.push_back(ranks);
    }
    return all;
}

ExactFriedman undefinedExact(const std::string& why) { return {Value::undefined(why), Value::undefined(why)}; }

}  // namespace

ExactFriedman exactFriedman(const BlockTable& table)
{
    if (table.blocks == 0 || table.conditions < 2) return undefinedExact("needs a block and at least 2 conditions");
    if (const std::string fault = nonFiniteFault(table.values, "the table"); !fault.empty()) return undefinedExact(fault);
    if (table.conditions > mostConditions) return undefinedExact("more than 7 conditions: read the approximate p");
    const std::string tooLarge = "too many blocks and conditions: read the approximate p";
    RankSumDistribution distribution(table.conditions, 2 * table.blocks * table.conditions);
    if (!distribution.fits()) return undefinedExact(tooLarge);
    RankSums observed{{}, table.conditions};
    auto blocks = ranksOf(table);
    for (RankSums& ranks : blocks) {
        for (std::size_t j = 0; j < table.conditions; ++j) observed.sum[j] += ranks.sum[j];
        ranks.sort();
    }
    // Sorted, so that the order of the participants changes no bit.
    std::sort(blocks.begin(), blocks.end(), [](const RankSums& a, const RankSums& b) { return a.sum < b.sum; });
    double steps = 0;
    for (const RankSums& ranks : blocks) {
        const auto orders = ordersOf(ranks);
        steps += static_cast<double>(orders.size()) * static_cast<double>(distribution.size());
        if (steps > mostOrders) return undefinedExact(tooLarge);
        distribution.add(orders);
    }
    const auto expected = static_cast<long long>(table.blocks * (table.conditions + 1));
    const long long spread = spreadOf(observed, expected);
    double p = 0;
    double less = 0;
    distribution.forEach(
        [&](const RankSums& sums, double probability) { (spreadOf(sums, expected) >= spread ? p : less) += probability; });
    if (less == 0) p = 1;
    return {std::min(p, 1.0), p <= 0.5 ? std::log(p) : std::log1p(-less)};
}

}  // namespace stats
