// PNG files through libpng.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "protocols/files/whole_file.h"

namespace rendering {

/// An image as CV_8UC1, CV_8UC3 (RGB), CV_16UC1 or CV_16UC3. Palettes are expanded, transparency is dropped.
/// Throws badInput naming the file: missing, not a PNG, truncated, larger than 2^28 pixels, or more than 3 * 2^28 bytes when
/// decoded. Texts, colour profiles and other descriptions are skipped.
cv::Mat readPng(const std::filesystem::path& file);

/// True where readPng() of a file with these bytes exchanges width and height. Then the mark of a camera lays the picture on its
/// side (orientation 5 to 8). Decodes nothing.
bool pngLiesOnItsSide(std::string_view png);

/// Writes 8 or 16 bits, grey or RGB, as a whole file. Throws environmentFault.
void writePng(const std::filesystem::path& file, const cv::Mat& image, protocols::Sync sync = protocols::Sync::Now);

}  // namespace rendering
