// Height maps of profilometers and GelSight scans: "Binary TrueMap Data File" version 2.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

namespace rendering {

struct TrueMap {
    cv::Mat heightMm;  ///< CV_32FC1; NaN where the file marks a missing point (-1e10) or holds no number
    double xPitchMm = 0, yPitchMm = 0;
    std::string comment;
};

/// A 32-byte header, a comment that ends with a zero byte, columns and rows (uint32), extent and offset in x and y (float32,
/// mm), then the heights (float32, mm) row by row; little endian. Throws badInput naming `where`: another format,
/// cut short, no points, more than 2^28 points, or an extent that is no length.
TrueMap trueMapFrom(std::string_view bytes, const std::string& where);
TrueMap readTrueMap(const std::filesystem::path& file);

}  // namespace rendering
