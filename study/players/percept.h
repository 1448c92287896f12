// What a simulated finger makes of a friction image: how slippery it is and how its friction varies
// from place to place. Computed from strokes (rendering/stroke.h), along both axes of the image.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace study::players {

struct Percept {
    static constexpr int bands = 6;  ///< octaves of temporal frequency, from 8 Hz
    double slipperiness = 0;         ///< natural logarithm of the mean coefficient of friction
    /// log10 of the r.m.s. coefficient in each band (along x, then along y), floored at the least
    /// variation that a finger notices.
    std::array<double, 2 * bands> texture{};
};

/// `image`: CV_8UC1. A constant image gives the floor in every band.
Percept feel(const cv::Mat& image);

/// Difference of slipperiness in just-noticeable differences (one is a Weber fraction of 0.2).
double slipperinessDistance(const Percept& a, const Percept& b);
/// Root mean square over the bands, in just-noticeable differences (one is 0.15 in log10).
double textureDistance(const Percept& a, const Percept& b);

}  // namespace study::players
