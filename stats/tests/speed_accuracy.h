// Speed and accuracy of choices taken together, without ever dividing by the number correct.
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

/// Bits per choice / mean seconds per choice.
Value bitsPerSecond(double proportionCorrect, int alternatives, double meanSeconds);

/// Balanced integration score (Liesefeld and Janczyk 2019): z(proportion correct) - z(time), both
/// standardised over all cells with the SD of the population. One score a cell; higher is better.
std::vector<Value> balancedIntegrationScores(std::span<const double> proportionCorrect, std::span<const double> seconds);

/// One bin of a conditional accuracy function: how often the choices of this speed were correct.
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

/// Bins end at the type-7 quantiles of the times, so that equal times share a bin whatever their order; a
/// bin may then be empty. Refused with a reason: no choices, numbers that differ, a time that is not finite.
ConditionalAccuracy conditionalAccuracy(std::span<const double> seconds, const std::vector<bool>& correct, std::size_t bins = 5);

}  // namespace stats
