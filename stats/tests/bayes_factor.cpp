#include "stats/tests/bayes_factor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stats/kernels/distributions.h"
#include "stats/kernels/exact_sum.h"

namespace stats {
namespace {

// In u = log g the integrand is analytic in a strip of half-width pi/2 at least, and falls off at both
// ends: the trapezoidal rule with this logGStep is exact to rounding.
constexpr double logGStep = 0.05;
constexpr double firstLogG = -8;   ///< exp(-1/(2g)) is below 1e-600 before it
constexpr double negligible = 45;  ///< below the peak, in natural logarithms

/// log(1 + t^2/(v nu)) where t^2 may be beyond the range of double.
double logOnePlusSquare(double t, double v, double nu)
{
    const double scaled = std::fabs(t) / std::sqrt(v * nu);
    return scaled > 1e8 ? 2 * std::log(scaled) : std::log1p(scaled * scaled);
}

/// log of the integrand over u = log g of the marginal likelihood of t.
double logIntegrand(double u, double t, double n, double width)
{
    const double g = std::exp(u);
    const double v = 1 + n * g * width * width;
    const double nu = n - 1;
    return -0.5 * std::log(v) - (nu + 1) / 2 * logOnePlusSquare(t, v, nu) - 0.5 * std::log(2 * std::numbers::pi) - u / 2 -
           1 / (2 * g);
}

double logMarginal(double t, double n, double width)
{
    std::vector<double> values;
    double peak = -std::numeric_limits<double>::infinity();
    // From here on the integrand can only fall.
    const double last = std::log(10 * (1 + std::min(t * t, 1e200))) - std::log(std::min(1.0, n * width * width));
    for (int i = 0;; ++i) {
        const double u = firstLogG + i * logGStep;
        values.push_back(logIntegrand(u, t, n, width));
        peak = std::max(peak, values.back());
        if (u > last && values.back() < peak - negligible) break;
    }
    return peak + std::log(logGStep * exactSum(values.size(), [&](std::size_t i) { return std::exp(values[i] - peak); }));
}

std::string faultOf(double t, long long n, double width)
{
    if (!std::isfinite(t)) return "t is not a finite number";
    if (n < 2) return "needs at least 2 values";
    if (!(width > 0) || !std::isfinite(width)) return "the prior's width must be a positive number";
    return {};
}

}  // namespace

JzsBayesFactor jzsBayesFactor(double t, long long n, double priorWidth)
{
    JzsBayesFactor result;
    result.why = faultOf(t, n, priorWidth);
    if (!result.why.empty()) {
        result.bf10 = result.logBf10 = Value::undefined(result.why);
        return result;
    }
    const auto size = static_cast<double>(n);
    const double logNull = -size / 2 * logOnePlusSquare(t, 1, size - 1);
    result.logBf10 = logMarginal(t, size, priorWidth) - logNull;
    result.bf10 = exponential(*result.logBf10);
    return result;
}

}  // namespace stats
