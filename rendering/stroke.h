// A simulated finger stroking a friction image: friction force over time, which simulated
// participants feel. Model: the finger pad averages the image over its contact (Gaussian, sigma =
// contactMm / 2), the display's friction rises linearly with the pixel value from the glass's own to
// its highest, and the force follows with a first-order response.
#pragma once

#include <opencv2/core/mat.hpp>

#include <vector>

namespace rendering {

struct StrokeOptions {
    double speedMmPerS = 50;
    double mmPerPixel = 0.170;
    double contactMm = 0.5;          ///< effective width of the contact for texture
    double normalForceN = 0.5;
    double glassFriction = 0.3;      ///< coefficient at pixel value 0
    double highestFriction = 0.9;    ///< at pixel value 255
    double responseS = 0.002;        ///< time constant of the skin's first-order response
    double sampleRateHz = 1000;
};

/// Force in N at each sample of one stroke from left to right along row `row` (vertical: top to
/// bottom along column `row`). `image`: CV_8UC1.
std::vector<double> strokeForce(const cv::Mat& image, int row, bool vertical, const StrokeOptions& options = {});

}  // namespace rendering
