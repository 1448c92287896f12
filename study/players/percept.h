// The percept of a friction image by a simulated finger: its slipperiness, and the variation of its friction from place to place.
// Computed from strokes (rendering/display/stroke.h) along both axes of the image.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace study::players {

struct Percept {
    static constexpr int bands = 6;  ///< octaves of temporal frequency, from 8 Hz
    double slipperiness = 0;         ///< natural logarithm of the mean coefficient of friction
    /// log10 of the root mean square coefficient in each band, along x, then along y. Variation below the threshold of a
    /// finger counts as the threshold.
    std::array<double, 2 * bands> texture{};
};

/// `image`: CV_8UC1, or CV_16UC1 with a full scale of 65535. A constant image gives the threshold in every band.
Percept feel(const cv::Mat& image);

/// Difference of slipperiness in just-noticeable differences (one is a Weber fraction of 0.2).
double slipperinessDistance(const Percept& a, const Percept& b);
/// Root mean square over the bands, in just-noticeable differences (one is 0.15 in log10).
double textureDistance(const Percept& a, const Percept& b);

}  // namespace study::players
