// How often the report's tests rejected in 10,000 simulated studies without anything to find, of the
// paper's design: 10 participants, 7 fabrics, 9 conditions, 3 alternatives. What calibration() counted;
// kept here because a report must not take minutes.
#pragma once

#include <span>
#include <string_view>

#include "stats/power/calibration.h"

namespace stats {

inline constexpr std::size_t measuredStudies = 10000;

struct MeasuredSize {
    std::string_view test;
    std::string_view truth;  ///< what the studies were drawn from
    Promise promise = Promise::Printed;
    std::size_t rejected = 0;   ///< of measuredStudies, at alpha = 0.05
    double attainableSize = 0;  ///< of exact tests; 0: not an exact test

    double rate() const { return static_cast<double>(rejected) / static_cast<double>(measuredStudies); }
    bool antiConservative() const { return rate() > 0.06; }
};

/// In the order of calibration().
std::span<const MeasuredSize> measuredSizes();

}  // namespace stats
