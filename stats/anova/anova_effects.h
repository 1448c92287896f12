// Tests of an effect from its sums of squares, for the designs of two factors.
#pragma once

#include <string>

#include "stats/anova/two_way_anova.h"
#include "stats/kernels/moments.h"

namespace stats {

/// Sums of squares of one effect, in the scale of the samples.
struct EffectSquares {
    double effect = 0;
    double error = 0;
    double generalError = 0;  ///< all variation that the generalised eta squared counts beside the effect
    double df1 = 0;
    double df2 = 0;
};

/// F, p and effect sizes. `squares.error` must be above 0.
AnovaEffect testedEffect(std::string name, const EffectSquares& squares, const ScaledSamples& scale);

/// An effect without a test, with the reason.
AnovaEffect untestedEffect(std::string name, const std::string& why);

/// A whole analysis without tests, with the reason.
TwoWayAnova refusedAnova(TwoWayAnova anova, const std::string& why);

}  // namespace stats
