// Least squares over rises between neighbouring pixels, each with a weight of its own: the surface whose rises are closest to
// the given ones. The cosine transform solves it only where all weights are equal. Conjugate gradients, preconditioned by one
// multigrid cycle, solve it for any weights, in a time that is proportional to the number of pixels.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// Weighted rises of an image; all CV_32FC1 and of one size.
struct WeightedRises {
    Slopes weights;   ///< >= 0, of the rise to the right neighbour (last column 0) and to the lower one (last row 0)
    cv::Mat sources;  ///< derivative of half of the sum below at height 0, with the opposite sign; it is overwritten
};

struct MultigridOptions {
    double residualToReach = 1e-6;  ///< RMS of the residual relative to that of the sources
    int mostIterations = 60;
};

/// Height, CV_64FC1, that minimises the sum of weight * (rise - given rise)^2. The height of a part that no weight joins to the
/// rest is determined up to a constant. Single precision inside; the threads are those of OpenCV.
cv::Mat surfaceOfWeightedRises(WeightedRises rises, const MultigridOptions& options = {});

}  // namespace rendering::signals
