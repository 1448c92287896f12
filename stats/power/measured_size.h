// Number of rejections by the report's tests in 10,000 simulated studies with a true null hypothesis, for the paper's
// design: 10 participants, 7 fabrics, 9 conditions, 3 alternatives. calibration() counted them; they are stored here
// because a report must not take minutes.
#pragma once

#include <span>
#include <string_view>

#include "stats/power/calibration.h"

namespace stats {

inline constexpr std::size_t measuredStudies = 10000;

struct MeasuredSize {
    std::string_view test;
    std::string_view truth;  ///< the model that the studies were drawn from
    Promise promise = Promise::Printed;
    std::size_t rejected = 0;   ///< rejections among measuredStudies, at alpha = 0.05
    double attainableSize = 0;  ///< largest size of an exact test up to alpha; 0: not an exact test

    double rate() const { return static_cast<double>(rejected) / static_cast<double>(measuredStudies); }
    bool antiConservative() const { return rate() > 0.06; }
};

/// In the order of calibration().
std::span<const MeasuredSize> measuredSizes();

}  // namespace stats
