// Descriptive statistics of one sample. NaN means missing here: it is counted and left out.
#pragma once

#include <cstddef>
#include <span>

#include "stats/kernels/value.h"

namespace stats {

struct Description {
    std::size_t n = 0;        ///< numbers used
    std::size_t missing = 0;  ///< NaN
    Value mean;
    Value sd;  ///< divisor n - 1
    Value variance;
    Value autocorrelationLag1;  ///< NIST's definition: sum of (x_i - m)(x_{i+1} - m) over sum of (x_i - m)^2
    Value median;
    Value q1;  ///< quartiles of type 7 (Hyndman and Fan 1996)
    Value q3;
    Value min;
    Value max;
    Interval ci95;  ///< confidence interval of the mean, Student's t; undefined without variation
};

/// Describes a sample. Where a value is infinite, everything but the counts is undefined.
Description describe(std::span<const double> x);

/// Type-7 quantile of finite numbers in ascending order, 0 <= probability <= 1. Undefined for no numbers.
Value quantile(std::span<const double> ascending, double probability);

/// Median of finite numbers in any order.
Value median(std::span<const double> x);

}  // namespace stats
