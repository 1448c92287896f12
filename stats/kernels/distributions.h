// Tail probabilities with their logarithms: the logarithm still has digits where p is below the smallest double.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "stats/kernels/value.h"

namespace stats {

struct TailProbability {
    double p = 1;     ///< 0 where it is below the smallest double: then read logP
    double logP = 0;  ///< natural logarithm
};

/// P(T >= t), Student's t with `df` > 0 degrees of freedom (not necessarily whole).
TailProbability studentUpper(double t, double df);
/// P(|T| >= |t|).
TailProbability studentTwoSided(double t, double df);
/// The t that is exceeded with probability `upperTail`, 0 < upperTail < 1.
double studentQuantile(double upperTail, double df);

/// Remembers the latest quantiles: the intervals of many contrasts often have the same degrees of freedom.
class StudentQuantiles {
public:
    /// studentQuantile(upperTail, df)
    double at(double upperTail, double df);

private:
    struct Known {
        double upperTail = 0, df = 0, t = 0;
    };
    std::array<Known, 4> m_known;
    std::size_t m_next = 0;
};

/// P(F >= f), f >= 0.
TailProbability fisherUpper(double f, double df1, double df2);
/// P(X >= x), chi-squared, x >= 0.
TailProbability chiSquaredUpper(double x, double df);
/// P(Z >= z).
TailProbability normalUpper(double z);
/// P(Z <= z), without a logarithm: 100 times as fast as normalUpper().
double normalLower(double z);
/// The z that is exceeded with probability `upperTail`.
double normalQuantile(double upperTail);

/// P(X <= x) of the beta distribution, P(X >= x), and the x at which P(X <= x) = p.
double betaLower(double a, double b, double x);
double betaUpper(double a, double b, double x);
double betaQuantile(double a, double b, double p);

/// Twice a tail (at most 1), and 1 minus a tail, with their logarithms.
TailProbability twice(const TailProbability& tail);
TailProbability complementOf(const TailProbability& tail);

/// e^logarithm; beyond the range of double, its decimal.
Value exponential(double logarithm);

/// e^logarithm as a decimal, "4.2000000000e-398", for numbers beyond the range of double.
std::string decimalOfLogarithm(double logarithm);

/// Hedges' correction factor of a standardised difference with m >= 2 degrees of freedom, in its exact form.
double hedgesCorrection(double m);

}  // namespace stats
