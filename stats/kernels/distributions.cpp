#include "stats/kernels/distributions.h"

#include <array>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <charconv>
#include <cmath>
#include <numbers>

#include "stats/kernels/quiet_policy.h"

namespace stats {
namespace {

namespace bm = boost::math;

// Below this, p is so small that it loses digits as a denormal number: its logarithm is then computed directly.
constexpr double smallestLinear = 1e-280;

/// log I_x(a, b) for x well below 1, from x^a (1-x)^b / (a B(a, b)) 2F1(a+b, 1; a+1; x), whose terms are all positive.
double logBetaLower(double a, double b, double logX, double x)
{
    double term = 1;
    double series = 1;
    for (double n = 0; n < 1e6 && term > series * 1e-17; ++n) {
        term *= (a + b + n) / (a + 1 + n) * x;
        series += term;
    }
    const double logBeta = bm::lgamma(a) + bm::lgamma(b) - bm::lgamma(a + b);
    return a * logX + b * std::log1p(-x) - std::log(a) - logBeta + std::log(series);
}

/// log Q(a, x), x > a + 1, from Legendre's continued fraction (modified Lentz algorithm).
double logGammaUpper(double a, double x)
{
    constexpr double tiny = 1e-300;
    double b = x + 1 - a;
    double c = 1 / tiny;
    double d = 1 / b;
    double fraction = d;
    for (int i = 1; i < 100000; ++i) {
        const double an = -i * (i - a);
        b += 2;
        d = an * d + b;
        d = 1 / (std::fabs(d) < tiny ? tiny : d);
        c = b + an / c;
        c = std::fabs(c) < tiny ? tiny : c;
        fraction *= d * c;
        if (std::fabs(d * c - 1) < 1e-16) break;
    }
    return a * std::log(x) - x - bm::lgamma(a) + std::log(fraction);
}

TailProbability fromLinear(double p) { return {p, std::log(p)}; }

TailProbability gammaUpper(double a, double x)
{
    const double p = bm::gamma_q(a, x, Quiet());
    if (p >= smallestLinear) return p > 0.5 ? TailProbability{p, std::log1p(-bm::gamma_p(a, x, Quiet()))} : fromLinear(p);
    return {p, logGammaUpper(a, x)};
}

}  // namespace

TailProbability twice(const TailProbability& tail)
{
    return {std::fmin(1.0, 2 * tail.p), std::fmin(0.0, tail.logP + std::numbers::ln2)};
}

TailProbability complementOf(const TailProbability& tail) { return {1 - tail.p, std::log1p(-tail.p)}; }

TailProbability studentUpper(double t, double df)
{
    if (t < 0) return complementOf(studentUpper(-t, df));
    if (t == 0) return {0.5, -std::numbers::ln2};  // the ratio below would be infinite, and for -0 negative
    // df / (df + t^2) without a square that can overflow.
    const double ratio = std::sqrt(df) / t;
    if (ratio < 1e-5 || t > 1e100) {
        const double x = t > 0 ? ratio * ratio / (1 + ratio * ratio) : 1;
        const double logX = 2 * std::log(ratio) - std::log1p(ratio * ratio);
        const double logP = logBetaLower(df / 2, 0.5, logX, x) - std::numbers::ln2;
        return {std::exp(logP), logP};
    }
    const double p = bm::cdf(bm::complement(bm::students_t_distribution<double, Quiet>(df), t));
    if (p >= smallestLinear) return fromLinear(p);
    const double x = df / (df + t * t);
    return {p, logBetaLower(df / 2, 0.5, std::log(x), x) - std::numbers::ln2};
}

TailProbability studentTwoSided(double t, double df)
{
    const double magnitude = std::fabs(t);
    if (magnitude < 0.5) {
        // P(-t < T < t) is small here; 1 - p therefore keeps its digits.
        const double squared = magnitude * magnitude;
        return complementOf({bm::ibeta(0.5, df / 2, squared / (df + squared), Quiet()), 0});
    }
    return twice(studentUpper(magnitude, df));
}

double studentQuantile(double upperTail, double df)
{
    return bm::quantile(bm::complement(bm::students_t_distribution<double, Quiet>(df), upperTail));
}

double StudentQuantiles::at(double upperTail, double df)
{
    for (const Known& known : m_known)
        if (known.upperTail == upperTail && known.df == df) return known.t;
    const double t = studentQuantile(upperTail, df);
    m_known[m_next++ % m_known.size()] = {upperTail, df, t};
    return t;
}

TailProbability fisherUpper(double f, double df1, double df2)
{
    if (f <= 0) return {1, 0};
    const double x = df2 / (df2 + df1 * f);
    const double p = bm::ibeta(df2 / 2, df1 / 2, x, Quiet());
    if (p >= smallestLinear)
        return p > 0.5 ? TailProbability{p, std::log1p(-bm::ibetac(df2 / 2, df1 / 2, x, Quiet()))} : fromLinear(p);
    return {p, logBetaLower(df2 / 2, df1 / 2, std::log(x), x)};
}

TailProbability chiSquaredUpper(double x, double df)
{
    if (x <= 0) return {1, 0};
    return gammaUpper(df / 2, x / 2);
}

TailProbability normalUpper(double z)
{
    if (z < 0) return complementOf(normalUpper(-z));
    const TailProbability both = gammaUpper(0.5, z * z / 2);
    return {both.p / 2, both.logP - std::numbers::ln2};
}

double normalLower(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

double normalQuantile(double upperTail)
{
    return bm::quantile(bm::complement(bm::normal_distribution<double, Quiet>(), upperTail));
}

double betaLower(double a, double b, double x) { return bm::ibeta(a, b, x, Quiet()); }

double betaUpper(double a, double b, double x) { return bm::ibetac(a, b, x, Quiet()); }

double betaQuantile(double a, double b, double p) { return bm::ibeta_inv(a, b, p, Quiet()); }

std::string decimalOfLogarithm(double logarithm)
{
    const long double tens = static_cast<long double>(logarithm) / std::numbers::ln10_v<long double>;
    long double exponent = std::floor(tens);
    // A logarithm of some hundreds determines about ten digits of its number.
    std::array<char, 40> text{};
    const auto write = [&] {
        const auto mantissa = std::pow(10.0L, tens - exponent);
        return std::string(text.data(),
                           std::to_chars(text.data(), text.data() + text.size(), mantissa, std::chars_format::fixed, 10).ptr);
    };
    std::string digits = write();
    if (digits.starts_with("10")) {  // rounded up
        exponent += 1;
        digits = write();
    }
    return digits + "e" + (exponent < 0 ? "" : "+") + std::to_string(static_cast<long long>(exponent));
}

Value exponential(double logarithm)
{
    const double number = std::exp(logarithm);
    return std::isfinite(number) || !std::isfinite(logarithm) ? Value(number)
                                                              : Value::beyondDouble(decimalOfLogarithm(logarithm));
}

double hedgesCorrection(double m) { return 1 / (bm::tgamma_delta_ratio((m - 1) / 2, 0.5, Quiet()) * std::sqrt(m / 2)); }

}  // namespace stats
