// TIFF files through libtiff.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "protocols/files/whole_file.h"

namespace rendering {

/// One channel, CV_32F, CV_8U or CV_16U. Throws badInput, also for a palette, other colours, a file in which 0 is white, and an
/// orientation other than upright.
cv::Mat readTiff(const std::filesystem::path& file);

/// One channel as readTiff(), or RGB: CV_8UC3 or CV_16UC3. Transparency is dropped. Throws badInput as readTiff().
cv::Mat readColourTiff(const std::filesystem::path& file);

/// Writes CV_32FC1, compressed by deflate with the floating-point predictor.
void writeTiff(const std::filesystem::path& file, const cv::Mat& image, protocols::Sync sync = protocols::Sync::Now);

}  // namespace rendering
