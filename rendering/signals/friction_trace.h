// A friction record as a trace for spectrograms and friction images: evenly sampled, finite, with its mean.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "rendering/fabrics/friction_record.h"

namespace rendering::signals {

struct FrictionTrace {
    std::vector<double> values;  ///< coefficient of friction, or the record's own quantity
    std::string quantity = "mu";
    double mean = 0;
    double sampleRateHz = 60;
    double mmPerSample = 0;  ///< stroke speed / sample rate
};

using fabrics::shortestTrace;

/// Trace at the record's sample rate, or at its mean rate where that is lower. Uneven time stamps are interpolated
/// linearly; denser ones are averaged over each period. `where` names the record in errors. Throws badInput for fewer
/// than shortestTrace samples, a value that is not finite, time stamps that do not increase, and where
/// fabrics::meanRateHz() and, for a coefficient, fabrics::requireAxisAlongStroke() do.
FrictionTrace frictionTrace(const fabrics::FrictionRecord& record, const std::string& where);

/// The values of a trace at another spacing: averaged where it becomes wider, interpolated where it becomes denser.
std::vector<double> atSpacing(std::span<const double> values, double mmPerSample, double wantedMmPerSample);

}  // namespace rendering::signals
