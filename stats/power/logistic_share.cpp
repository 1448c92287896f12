#include "stats/power/logistic_share.h"

#include <cmath>

namespace stats {

double shareOfLogOdds(double x) { return 1 / (1 + std::exp(-x)); }

double meanShare(double intercept, double sd)
{
    double sum = 0, weight = 0;
    for (int k = -160; k <= 160; ++k) {
        const double x = k / 20.0, density = std::exp(-x * x / 2);
        sum += density * shareOfLogOdds(intercept + x * sd);
        weight += density;
    }
    return sum / weight;
}

double interceptFor(double share, double sd)
{
    double low = -12, high = 12;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (meanShare(middle, sd) < share ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace stats
