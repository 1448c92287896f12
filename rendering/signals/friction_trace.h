// A friction record as the trace that spectrograms and friction images are made of: evenly sampled,
// finite, with its mean as a value of its own.
#pragma once

#include <string>
#include <vector>

#include "rendering/fabrics/dataset.h"

namespace rendering::signals {

struct FrictionTrace {
    std::vector<double> values;  ///< coefficient of friction, or the record's own quantity
    std::string quantity = "mu";
    double mean = 0;
    double sampleRateHz = 60;
    double mmPerSample = 0;  ///< stroke speed / sample rate
};

/// Shorter records say nothing about texture.
inline constexpr int shortestTrace = 8;

/// Evenly spaced at the record's sample rate, or at its own mean rate where that is lower: uneven time
/// stamps are interpolated linearly, denser ones averaged over each period. `where` names the record in
/// errors. Throws badInput for fewer than shortestTrace samples, a value that is not finite, or time
/// stamps that do not rise.
FrictionTrace frictionTrace(const fabrics::FrictionRecord& record, const std::string& where);

}  // namespace rendering::signals
