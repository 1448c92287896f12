// Heights of many frames of one sensor, one after another, in single precision: heightFromFrame() at IntegrationQuality::Fast
// with all tables prepared. The high-pass filter acts in the transform of the integration, which saves two transforms.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "rendering/signals/slope_differences.h"
#include "rendering/signals/tactile/calibration.h"

namespace rendering::signals {

class FrameHeights {
public:
    /// `reference`: frame of the untouched sensor, as lightOf() takes it. Throws badInput where it does not fit the calibration.
    FrameHeights(const Calibration& calibration, const cv::Mat& reference);

    /// Height above the low percentile of the calibration, mm, >= 0, CV_32FC1 of the size of the frame; valid until the next
    /// call. The percentile is exact within 1/4096 of the range of heights. Throws badInput as slopesFromFrame() does.
    const cv::Mat& heightOf(const cv::Mat& frame);

    cv::Size size() const { return m_reference.size(); }

private:
    Calibration m_calibration;
    cv::Mat m_reference;
    SlopeDifferences<float> m_differences;
    cv::Mat m_factors;  ///< from the transform of the sources to that of the filtered height
    cv::Mat m_height;
    std::vector<int> m_counts;
};

}  // namespace rendering::signals
