#include "stats/tests/multiplicity.h"

#include <algorithm>
#include <cmath>

namespace stats {
namespace {

double harmonic(std::size_t m)
{
    double sum = 0;
    for (std::size_t i = 1; i <= m; ++i) sum += 1 / static_cast<double>(i);
    return sum;
}

/// Factor of the p of this rank (0 = smallest of m), before the values are made monotone. It is a single factor,
/// so that a denormal p is rounded only once.
double factorOf(std::size_t rank, std::size_t m, Adjustment method, double harmonicSum)
{
    const auto members = static_cast<double>(m);
    const double place = static_cast<double>(rank) + 1;
    switch (method) {
        case Adjustment::Holm:
        case Adjustment::Hochberg:
            return members - static_cast<double>(rank);
        case Adjustment::Bonferroni:
            return members;
        case Adjustment::BenjaminiHochberg:
            return members / place;
        case Adjustment::BenjaminiYekutieli:
            return members * harmonicSum / place;
    }
    return 1;
}

}  // namespace

std::vector<Value> adjusted(std::span<const Value> p, Adjustment method)
{
    std::vector<Value> result(p.begin(), p.end());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p[i].exists()) order.push_back(i);
    std::sort(order.begin(), order.end(), [p](std::size_t a, std::size_t b) { return *p[a] < *p[b]; });
    const double harmonicSum = method == Adjustment::BenjaminiYekutieli ? harmonic(order.size()) : 1;
    std::vector<double> values(order.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank)
        values[rank] = std::min(1.0, *p[order[rank]] * factorOf(rank, order.size(), method, harmonicSum));
    if (method == Adjustment::Holm) {
        for (std::size_t rank = 1; rank < values.size(); ++rank) values[rank] = std::max(values[rank], values[rank - 1]);
    } else if (method != Adjustment::Bonferroni) {
        for (std::size_t rank = values.size(); rank-- > 1;) values[rank - 1] = std::min(values[rank - 1], values[rank]);
    }
    for (std::size_t rank = 0; rank < order.size(); ++rank) result[order[rank]] = std::max(values[rank], *p[order[rank]]);
    return result;
}

}  // namespace stats
