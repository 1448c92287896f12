// The length that pitches are told in. No torch here.
#pragma once

namespace rendering::models {

/// The networks are told the logarithm of millimetres a pixel over this.
inline constexpr double pitchUnitMm = 0.05;

}  // namespace rendering::models
