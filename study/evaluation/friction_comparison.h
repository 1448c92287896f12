// Comparison of a generated with a measured friction trace: sample by sample, by mean and by spectrum.
#pragma once

#include <vector>

#include "study/evaluation/measures.h"

namespace study::evaluation {

/// Friction over distance.
struct Trace {
    std::vector<double> values;  ///< coefficient of friction
    double mmPerSample = 0;      ///< sample spacing, mm; 0 for a constant trace
};

/// Trace of `length` equal samples.
Trace constantTrace(double value, std::size_t length);

/// The trace at another spacing: averaged where it becomes wider, interpolated where it becomes denser. Unchanged if the spacings
/// agree within 1 %, because stated rates and speeds are rounded.
Trace atSpacing(Trace trace, double mmPerSample);

struct FrictionFeatures {
    double mean = 0;
    /// Powers of the trace over its mean in eight frequency bands: 0 for a constant, empty below 64 samples.
    std::vector<double> bandPowers;
};
FrictionFeatures frictionFeatures(const Trace& trace);

/// Sets all friction measures except identification. Uses the samples that both traces have. `modelMmPerSample`: spacing of the
/// model; a segment of the spectrum spans 64 such samples, also where the measured trace has fewer there. Frequencies that a
/// coarser record does not reach are left out. 0: segments of 64 measured samples.
void compareTraces(const Trace& generated, const Trace& measured, Values& values, double modelMmPerSample = 0);

/// MAE/mean of a constant at the mean of the stroke: the error that remains without texture.
stats::Value ownMeanError(const Trace& measured);

}  // namespace study::evaluation
