// The passes over long samples, a block of the cache at a time and four numbers of a vector register at
// once. Every processor takes the same additions in the same order, so that the bits do not depend on it.
#pragma once

#include <cstddef>

namespace stats {

struct BlockSums {
    double mean = 0;      ///< nearest double to the mean, up to rounding
    double residual = 0;  ///< sum of x - mean
    double squares = 0;   ///< sum of (x - mean)^2
    double smallest = 0;
    double largest = 0;
};

/// Of n >= 1 finite numbers whose sum does not overflow.
void blockSums(const double* x, std::size_t n, BlockSums& sums);

/// x - y into `differences`.
void subtract(const double* x, const double* y, double* differences, std::size_t n);

/// Sum of |x|: finite exactly when all numbers are finite and their sum does not overflow.
double sumOfMagnitudes(const double* x, std::size_t n);

}  // namespace stats
