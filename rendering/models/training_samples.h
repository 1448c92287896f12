// Pictures of photographs with measured and generated heights.
#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

namespace rendering::models {

/// A row of samples-STEP.png; both heights have one scale. An empty height is marked "not measured".
struct SampleRow {
    std::string label;          ///< ASCII, e.g. "F03"
    cv::Mat photograph;         ///< CV_8UC3, RGB
    cv::Mat trueHeightMm;       ///< CV_32FC1
    cv::Mat generatedHeightMm;  ///< CV_32FC1
};

/// CV_8UC3: one row for each sample with label, photograph, measured and generated height and their common scale in mm.
cv::Mat samplePicture(int step, std::span<const SampleRow> rows);

}  // namespace rendering::models
