// Least squares over rises between neighbouring pixels, each with a weight of its own: the surface whose rises are closest to
// the given ones. The cosine transform solves it only where all weights are equal. Conjugate gradients, preconditioned by one
// multigrid cycle, solve it for any weights, in a time that is proportional to the number of pixels. Where their residual stays
// too large, and for pixels much longer than wide, conjugate gradients with the cosine transform go on in double precision.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// Weighted rises of an image; all CV_32FC1 and of one size. The sources may be CV_64FC1: pixels much longer than wide need it.
struct WeightedRises {
    Slopes weights;   ///< >= 0, of the rise to the right neighbour (last column 0) and to the lower one (last row 0)
    cv::Mat sources;  ///< derivative of half of the sum below at height 0, with the opposite sign
};

struct MultigridOptions {
    double residualToReach = 1e-6;   ///< RMS of the residual relative to that of the sources
    int mostIterations = 60;         ///< of multigrid
    double residualToAccept = 2e-6;  ///< after multigrid; rounding leaves a little more than it sees
};

/// Height, CV_64FC1, that minimises the sum of weight * (rise - given rise)^2. The height of a part that no weight joins to the
/// rest is determined up to a constant. Single precision inside multigrid; the threads are those of OpenCV. Throws badInput where
/// the sources are not finite, and workFailed where the residual stays above 1e-4 and above `residualToAccept`.
cv::Mat surfaceOfWeightedRises(const WeightedRises& rises, const MultigridOptions& options = {});

}  // namespace rendering::signals
