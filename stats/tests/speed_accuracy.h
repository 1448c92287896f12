// Speed and accuracy of choices combined. No measure divides by the number of correct choices.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

struct ResponseTimes {
    std::size_t n = 0;
    Value median;         ///< seconds
    Value logMean;        ///< mean of the natural logarithms; undefined where a time is not positive
    Value geometricMean;  ///< seconds, exp(logMean)
    Value mean;           ///< seconds
};

ResponseTimes responseTimes(std::span<const double> seconds);

/// Information of one choice among m equally likely alternatives, bits (Wolpaw et al. 1998):
/// log2 m + p log2 p + (1 - p) log2((1 - p)/(m - 1)); 0 at or below chance.
Value bitsPerChoice(double proportionCorrect, int alternatives);

/// Information per second: bits per choice / mean seconds per choice.
Value bitsPerSecond(double proportionCorrect, int alternatives, double meanSeconds);

/// Balanced integration score (Liesefeld and Janczyk 2019): z(proportion correct) - z(time), both
/// standardised over all cells with the SD of the population. One score for each cell; higher is better.
std::vector<Value> balancedIntegrationScores(std::span<const double> proportionCorrect, std::span<const double> seconds);

/// One bin of a conditional accuracy function: the accuracy of the choices of this speed.
struct AccuracyBin {
    std::size_t n = 0;
    Value meanSeconds;
    Value proportionCorrect;
    Interval ci95;  ///< Wilson
};

struct ConditionalAccuracy {
    std::string why;                ///< empty when the bins exist
    std::vector<AccuracyBin> bins;  ///< from fast to slow
};

/// Conditional accuracy function. Bins end at the type-7 quantiles of the times: equal times share a bin, and a
/// bin may be empty. Refused with a reason: no choices, sizes that differ, a time that is not finite.
ConditionalAccuracy conditionalAccuracy(std::span<const double> seconds, const std::vector<bool>& correct, std::size_t bins = 5);

}  // namespace stats
