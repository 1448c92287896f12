// A simulated finger that strokes a friction image: friction force over time, for simulated participants. The finger
// pad averages the image over its contact (Gaussian, sigma = contactMm / 2). The display's friction rises linearly with
// the pixel value from that of the glass to its highest value. The force follows with a first-order response:
// responseS * dF/dt + F = driving force, solved exactly for a drive that is linear between two samples.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace rendering {

struct StrokeOptions {
    double speedMmPerS = 50;
    double mmPerPixel = 0.170;
    double contactMm = 0.5;  ///< effective width of the contact for texture
    double normalForceN = 0.5;
    double glassFriction = 0.3;    ///< coefficient at pixel value 0
    double highestFriction = 0.9;  ///< at pixel value 255
    double responseS = 0.002;      ///< time constant of the skin's first-order response
    double sampleRateHz = 1000;
};

/// One sample of a stroke.
struct StrokeSample {
    double timeS = 0;
    double positionMm = 0;  ///< centre of the finger, from the centre of the first pixel
    double normalN = 0;
    double tangentialN = 0;
    bool operator==(const StrokeSample&) const = default;
};

/// One stroke from left to right along row `line` (vertical: from top to bottom along column `line`), at least one sample.
/// `image`: CV_8UC1, or CV_16UC1 with a full scale of 65535. Throws badInput for options out of range and for a speed at which
/// the stroke would take more than 10^7 samples.
std::vector<StrokeSample> strokeImage(const cv::Mat& image, int line, bool vertical, const StrokeOptions& options = {});

/// CSV with the columns t_s,position_mm,normal_n,tangential_n; the shortest numbers that read back exactly.
std::string strokeCsv(const std::vector<StrokeSample>& samples);

/// Tangential forces of `strokeImage`, N.
std::vector<double> strokeForce(const cv::Mat& image, int row, bool vertical, const StrokeOptions& options = {});

}  // namespace rendering
