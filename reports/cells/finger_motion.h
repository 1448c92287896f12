// Speed and force of a finger on the display, from the samples of one presentation.
#pragma once

#include <optional>
#include <span>

#include "protocols/finger_sample.h"

namespace reports {

struct FingerMotion {
    double contactSeconds = 0;          ///< between samples of one contact
    std::optional<double> speedMmPerS;  ///< length of the path through its time
    std::optional<double> forceN;       ///< mean over time
};

/// Samples of one contact lie at most this far apart, s.
inline constexpr double longestGapSeconds = 0.1;
/// Least time in contact that gives a speed and a force, s.
inline constexpr double leastContactSeconds = 0.2;
/// The path joins positions that are at least this far apart in time, s: noise of a sensor lengthens a path of shorter steps.
inline constexpr double leastStepSeconds = 0.02;

/// `samples`: in the order of time. A sample with a force of 0 or less is no contact. Values are missing where fewer than
/// leastContactSeconds were measured.
FingerMotion motionOf(std::span<const protocols::FingerSample> samples);

}  // namespace reports
