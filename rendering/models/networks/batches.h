// Batches drawn from the training data. In a weakly paired data set photograph, height map and stroke are drawn
// independently from the same fabric (paper, section IV). In an aligned one they are drawn at the same place.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "protocols/random.h"
#include "rendering/models/networks/training_data.h"

namespace rendering::models {

/// A batch in the layout of the networks (N x C x H x W, row-major).
struct Batch {
    int size = 0, crop = 0, rows = 0, frames = 0;
    int margin = 0;                  ///< px of height around the crop, in which a map is registered
    std::vector<float> photographs;  ///< [N, 3, crop, crop], 0 to 1
    std::vector<float> heights;      ///< [N, 1, crop + 2 margin, crop + 2 margin], units of heightScaleMm
    std::vector<float> rings;        ///< [N, ringCount]: radial power spectra of the heights
    std::vector<float> logRatios;    ///< [N, 1, rows, frames]
    std::vector<float> means;        ///< [N, 1]
    /// For validation only: other measured samples of the same fabrics in the same orientation; heights of crop x crop.
    std::vector<float> otherHeights, otherRings, otherLogRatios, otherMeans;
};

struct BatchOptions {
    int size = 8;
    /// True (training): photograph and height are rotated by one angle and flipped jointly. Some pairs are zoomed jointly,
    /// with their heights, so that slopes stay: this is a finer or coarser fabric of the same make. Photographs vary in
    /// brightness and colour, have Gaussian noise, and some are grey. False (validation): the photograph stays, the height
    /// is rotated to match.
    bool augment = true;
    int margin = 0;       ///< px; 0 in an aligned data set
    bool heights = true;  ///< false: photographs and strokes only
};

/// Draws a batch. Each fabric occurs once before any occurs again, in random order.
Batch drawBatch(const TrainingData& data, const std::vector<TrainingFabric>& part, const BatchOptions& options,
                protocols::Random& random);

/// Crop of `side` px around `centre`, rotated by `angleDeg` anticlockwise; a pixel of it covers `zoom` pixels of the image.
/// Mirrored at the image's border. Bilinear, for heights cubic. Angle 0 at whole pixels copies.
cv::Mat turnedCrop(const cv::Mat& image, cv::Point2d centre, double angleDeg, int side, double zoom = 1);

}  // namespace rendering::models
