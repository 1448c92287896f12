// Time stamps of records: their regularity, and resampling to even steps.
#pragma once

#include <string>
#include <vector>

namespace rendering::fabrics {

struct TimeBase {
    double stepS = 0;  ///< median step
    bool even = true;  ///< true where every step lies within 2 % of the median
    double smallestS = 0, largestS = 0;
};

/// Throws badInput for fewer than two stamps, and where time does not increase, naming the row (from 1).
TimeBase timeBaseOf(const std::vector<double>& timeS, const std::string& where);

/// Values at multiples of `stepS` after the first stamp. Linear between neighbours; no value lies after the last stamp.
std::vector<double> atEvenSteps(const std::vector<double>& timeS, const std::vector<double>& values, double stepS);

/// Means of the samples within half a step of the multiples of `stepS`, linear between neighbours where a step has no
/// sample. Use it for steps longer than those of the record, because the means suppress aliasing.
std::vector<double> meansAtEvenSteps(const std::vector<double>& timeS, const std::vector<double>& values, double stepS);

}  // namespace rendering::fabrics
