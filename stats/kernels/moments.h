// Mean and sum of squared deviations that survive offsets (1e15 + small) and scales (2^±600,
// denormals, sums beyond 1e308): data are brought near 1 by a power of two, which is exact, and
// summed in two passes around their mean.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// Several samples divided by one common power of two. Nothing is copied in the everyday range.
class ScaledSamples {
public:
    /// `references`: further numbers of the same unit (a tested mean, bounds) that must not overflow.
    ScaledSamples(std::initializer_list<std::span<const double>> samples, std::initializer_list<double> references = {});

    ScaledSamples(const ScaledSamples&) = delete;
    ScaledSamples& operator=(const ScaledSamples&) = delete;

    std::span<const double> sample(std::size_t index) const { return m_samples[index]; }
    double scaled(double reference) const;
    /// Back to the unit of the data; a decimal where it is beyond the range of double.
    Value unscaled(double number) const;
    /// The same for the square of a unit.
    Value unscaledSquare(double number) const;
    int exponent() const { return m_exponent; }

private:
    int m_exponent = 0;
    std::vector<std::vector<double>> m_copies;
    std::vector<std::span<const double>> m_samples;
};

struct Moments {
    std::size_t n = 0;
    double shift = 0;     ///< near the mean
    double residual = 0;  ///< mean - shift
    double squares = 0;   ///< sum of (x - mean)^2
    double smallest = 0;
    double largest = 0;

    double mean() const { return shift + residual; }
    /// Mean minus `reference`, without the cancellation of mean() - reference.
    double meanMinus(double reference) const { return (shift - reference) + residual; }
    /// Of a sample, n >= 2.
    double variance() const { return squares / static_cast<double>(n - 1); }
};

/// Of finite numbers of moderate size (ScaledSamples); n >= 1.
Moments momentsOf(std::span<const double> x);

struct PairedMoments {
    Moments x;
    Moments y;
    Moments differences;  ///< of x - y
};

/// Of equally many numbers, one look at each pair; n >= 1.
PairedMoments pairedMomentsOf(std::span<const double> x, std::span<const double> y);

/// All numbers equal but for the last bit of the largest: the spread is rounding noise, not data.
bool isConstant(const Moments& moments);

/// "value 3 of x is not a number", or empty when all numbers are finite. Counted from 1.
std::string nonFiniteFault(std::span<const double> x, const std::string& name);

/// Distance from |x| to the next larger double.
double unitInLastPlace(double x);

}  // namespace stats
