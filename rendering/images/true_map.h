// Height maps of profilometers and GelSight scanners in the format "Binary TrueMap Data File" version 2.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

namespace rendering {

struct TrueMap {
    cv::Mat heightMm;  ///< CV_32FC1; NaN where the file marks a missing point (-1e10) or holds a value that is not finite
    double xPitchMm = 0, yPitchMm = 0;
    std::string comment;
};

/// Reads a height map from the bytes of a file. All numbers are little endian. A header of 32 bytes and a comment that ends
/// with a zero byte come first. Then follow columns and rows (uint32), extent and offset in x and y (float32, mm), and the
/// heights row by row (float32, mm). Throws badInput naming `where`: unknown header, truncated, no points, more than 2^28
/// points, or an extent that is not positive.
TrueMap trueMapFrom(std::string_view bytes, const std::string& where);
TrueMap readTrueMap(const std::filesystem::path& file);

}  // namespace rendering
