// Sums over a block of a long sample, four numbers of a vector register at a time. Every processor does the
// same additions in the same order, so that all processors give the same bits.
#pragma once

#include <cstddef>

namespace stats {

struct BlockSums {
    double mean = 0;      ///< rounded
    double residual = 0;  ///< sum of x - mean
    double squares = 0;   ///< sum of (x - mean)^2
    double smallest = 0;
    double largest = 0;
};

/// Computes all fields for n >= 1 finite numbers whose sum does not overflow.
void blockSums(const double* x, std::size_t n, BlockSums& sums);

/// Writes x - y into `differences`.
void subtract(const double* x, const double* y, double* differences, std::size_t n);

/// Sum of |x|. It is finite exactly when all numbers are finite and their sum does not overflow.
double sumOfMagnitudes(const double* x, std::size_t n);

}  // namespace stats
