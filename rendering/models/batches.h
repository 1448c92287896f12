// Batches drawn from the training data. Weakly paired data sets draw photograph, height map and
// stroke independently from the same fabric (paper, section IV); aligned ones draw them at the same
// place.
#pragma once

#include "protocols/random.h"
#include "rendering/models/training_data.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace rendering::models {

/// One batch in the layout of the networks (N x C x H x W, row-major).
struct Batch {
    int size = 0, crop = 0, rows = 0, frames = 0;
    std::vector<float> photographs;  ///< [N, 3, crop, crop], 0..1
    std::vector<float> heights;      ///< [N, 1, crop, crop], units of heightScaleMm
    std::vector<float> logRatios;    ///< [N, 1, rows, frames]
    std::vector<float> means;        ///< [N, 1]
    /// Validation only: other measured samples of the same fabrics, turned alike.
    std::vector<float> otherHeights, otherLogRatios, otherMeans;
};

/// Fabrics in turn of a shuffled deck, crops turned (photograph and height by one joint angle) and
/// flipped jointly, photographs jittered in brightness and colour and with Gaussian noise.
/// Without `augment` (validation): the photograph as taken, the height turned to match, no flips.
Batch drawBatch(const TrainingData& data, const std::vector<FabricSamples>& part, int size, bool augment,
                protocols::Random& random);

/// The crop of `image` of `side` px whose centre lies at `centre`, turned by `angleDeg` anticlockwise,
/// mirrored at the image's border, bilinear. Angle 0 at whole pixels copies.
cv::Mat turnedCrop(const cv::Mat& image, cv::Point2d centre, double angleDeg, int side);

}  // namespace rendering::models
