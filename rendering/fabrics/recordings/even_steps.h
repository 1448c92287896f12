// Records with uneven time stamps brought to even ones.
#pragma once

#include <string>
#include <vector>

namespace rendering::fabrics {

struct TimeBase {
    double stepS = 0;  ///< the median step
    bool even = true;  ///< every step within 2 % of the median
    double smallestS = 0, largestS = 0;
};

/// Throws badInput naming the row (from 1) where time does not increase, and for fewer than two stamps.
TimeBase timeBaseOf(const std::vector<double>& timeS, const std::string& where);

/// Values at 0, step, 2 step ... after the first stamp, linear between neighbours, never beyond the last stamp.
std::vector<double> atEvenSteps(const std::vector<double>& timeS, const std::vector<double>& values, double stepS);

/// Means of the samples within half a step of 0, step, 2 step ...; linear between neighbours where there are none.
/// For steps longer than the record's own: leaves out what they cannot hold rather than folding it.
std::vector<double> meansAtEvenSteps(const std::vector<double>& timeS, const std::vector<double>& values, double stepS);

}  // namespace rendering::fabrics
