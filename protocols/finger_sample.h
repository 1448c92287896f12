// What a sensor of the display measured of the participant's finger at one moment.
#pragma once

#include <cstdint>
#include <optional>

namespace protocols {

/// A value is missing where the display has no sensor for it.
struct FingerSample {
    std::int64_t atNs = 0;         ///< the session's monotonic clock
    std::optional<double> xMm;     ///< from the left edge of the surface, to the right
    std::optional<double> yMm;     ///< from the upper edge of the surface, downwards
    std::optional<double> forceN;  ///< normal force; 0 or less: the finger hovers
    bool operator==(const FingerSample&) const = default;
};

}  // namespace protocols
