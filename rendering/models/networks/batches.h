// Batches drawn from the training data. Weakly paired data sets draw photograph, height map and
// stroke independently from the same fabric (paper, section IV); aligned ones draw them at the same
// place.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "protocols/random.h"
#include "rendering/models/networks/training_data.h"

namespace rendering::models {

/// One batch in the layout of the networks (N x C x H x W, row-major).
struct Batch {
    int size = 0, crop = 0, rows = 0, frames = 0;
    int margin = 0;                  ///< of the heights around the crop, px: where a registered map is looked for
    std::vector<float> photographs;  ///< [N, 3, crop, crop], 0..1
    std::vector<float> heights;      ///< [N, 1, crop + 2 margin, crop + 2 margin], units of heightScaleMm
    std::vector<float> rings;        ///< [N, ringCount]: radial spectra of the heights
    std::vector<float> logRatios;    ///< [N, 1, rows, frames]
    std::vector<float> means;        ///< [N, 1]
    /// Validation only: other measured samples of the same fabrics, turned alike; heights of crop x crop.
    std::vector<float> otherHeights, otherRings, otherLogRatios, otherMeans;
};

struct BatchWish {
    int size = 8;
    /// Training: crops turned (photograph and height by one joint angle) and flipped jointly, some of them
    /// jointly zoomed (heights too, so that slopes stay: a finer or coarser fabric of the same make),
    /// photographs jittered in brightness and colour, some of them grey, with Gaussian noise. Else (validation): the
    /// photograph as taken, the height turned to match, no flips.
    bool augment = true;
    int margin = 0;       ///< px; 0 in an aligned data set
    bool heights = true;  ///< else photographs and strokes only
};

/// Fabrics in turn of a shuffled deck.
Batch drawBatch(const TrainingData& data, const std::vector<FabricSamples>& part, const BatchWish& wish,
                protocols::Random& random);

/// The crop of `image` of `side` px whose centre lies at `centre`, turned by `angleDeg` anticlockwise, a
/// pixel of it showing `zoom` pixels of the image,
/// mirrored at the image's border; bilinear, heights cubic. Angle 0 at whole pixels copies.
cv::Mat turnedCrop(const cv::Mat& image, cv::Point2d centre, double angleDeg, int side, double zoom = 1);

}  // namespace rendering::models
