// Mean and sum of squared deviations that stay accurate for large offsets (1e15 + small) and extreme scales
// (2^±600, denormal numbers, sums beyond 1e308). Data are multiplied by a power of two, which is exact, and
// summed in two passes about their mean.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// Several samples divided by one common power of two. Samples of ordinary size are not copied.
class ScaledSamples {
public:
    /// `references`: further numbers of the same unit (a tested mean, bounds) that must not overflow.
    ScaledSamples(std::initializer_list<std::span<const double>> samples, std::initializer_list<double> references = {});

    ScaledSamples(const ScaledSamples&) = delete;
    ScaledSamples& operator=(const ScaledSamples&) = delete;

    std::span<const double> sample(std::size_t index) const { return m_samples[index]; }
    /// A reference in the unit of the scaled samples.
    double scaled(double reference) const;
    /// The number in the unit of the data; its decimal where it is beyond the range of double.
    Value unscaled(double number) const;
    /// The same for a squared unit.
    Value unscaledSquare(double number) const;
    int exponent() const { return m_exponent; }

private:
    int m_exponent = 0;
    std::vector<std::vector<double>> m_copies;
    std::vector<std::span<const double>> m_samples;
};

struct Moments {
    std::size_t n = 0;
    double shift = 0;     ///< a number near the mean
    double residual = 0;  ///< mean - shift
    double squares = 0;   ///< sum of (x - mean)^2
    double smallest = 0;
    double largest = 0;

    double mean() const { return shift + residual; }
    /// Mean minus `reference`, without the cancellation of mean() - reference.
    double meanMinus(double reference) const { return (shift - reference) + residual; }
    /// Variance of a sample, n >= 2.
    double variance() const { return squares / static_cast<double>(n - 1); }
};

/// Moments of n >= 1 finite numbers of moderate size (ScaledSamples).
Moments momentsOf(std::span<const double> x);

struct PairedMoments {
    Moments x;
    Moments y;
    Moments differences;  ///< x - y
};

/// Moments of n >= 1 pairs, in one pass over the data.
PairedMoments pairedMomentsOf(std::span<const double> x, std::span<const double> y);

/// True where all numbers are equal up to the last bit of the largest: their spread is rounding error.
bool isConstant(const Moments& moments);

/// Whether the scaled numbers are whole in their own unit; whole numbers are exact, whatever their size.
bool areWhole(std::span<const double> scaled, int exponent);

/// Units in the last place by which equal numbers may differ that were computed, such as means of ratings and their differences.
inline constexpr double computedNoise = 32;

/// True where numbers that were computed differ by no more than rounding.
bool isConstantButForRounding(const Moments& moments, std::span<const double> scaled, int exponent);

/// "value 3 of x is not a number", counted from 1; empty where all numbers are finite.
std::string nonFiniteFault(std::span<const double> x, const std::string& name);

/// Distance from |x| to the next larger double.
double unitInLastPlace(double x);

}  // namespace stats
