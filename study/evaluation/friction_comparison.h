// A generated against a measured friction trace: sample by sample, by its mean, and by its spectrum.
#pragma once

#include <vector>

#include "study/evaluation/measures.h"

namespace study::evaluation {

struct Trace {
    std::vector<double> values;  ///< coefficient of friction
    double mmPerSample = 0;      ///< 0 where it makes no difference: a constant
};

/// `length` samples of one value.
Trace constantTrace(double value, std::size_t length);

/// Linearly interpolated; the trace itself where the spacings agree within 1 %.
Trace atSpacing(Trace trace, double mmPerSample);

struct FrictionFeatures {
    double mean = 0;
    std::vector<double> bandPowers;  ///< of the trace over its mean, in eight bands of frequency: 0 for a constant, empty for a
                                     ///< trace below 64 samples
};
FrictionFeatures frictionFeatures(const Trace& trace);

/// All friction measures but identification, over the samples that both traces have.
void compareTraces(const Trace& generated, const Trace& measured, Values& values);

/// MAE/mean of a constant at the stroke's own mean: what no constant does better than.
stats::Value ownMeanError(const Trace& measured);

}  // namespace study::evaluation
