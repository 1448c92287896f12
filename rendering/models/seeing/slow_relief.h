// What counts as slow in relief: a photograph tells little of it, and a finger feels little of it. No torch here.
#pragma once

namespace rendering::models {

/// Standard deviation of the Gaussian whose result counts as slow, px.
inline constexpr double slowSigmaPx = 16;

}  // namespace rendering::models
