// Normal maps as slopes, and the sign of their green channel.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "rendering/scans/scan_files.h"
#include "rendering/signals/surface_integration.h"

namespace rendering::scans {

/// Slopes (CV_32FC1, x to the right, y downwards) of a tangent normal map: CV_8UC3 or CV_16UC3, where 0 and the largest value
/// stand for -1 and 1. Green is read as pointing up. A map without a usable blue channel gets it from the other two. Slopes
/// end at 10. Throws badInput naming `where` where the image is grey, or does not point out of the surface.
signals::Slopes slopesOfNormals(const cv::Mat& normals, const std::string& where);

struct GreenSign {
    bool isUp = true;
    std::string remark;  ///< how it was found
};

/// Whether green points up (OpenGL). `slopes` are read as if it did. `displacement` (CV_32FC1, any size; may be empty) counts
/// where it resembles the heights of one sign only; then the agreement of the slopes; then the file name.
GreenSign greenSignOf(const signals::Slopes& slopes, const cv::Mat& displacement, GreenUp stated);

/// Correlation of two height maps without their waves far longer than 16 px of the coarser one; they are brought to the
/// coarser grid.
double heightCorrelation(const cv::Mat& a, const cv::Mat& b);

}  // namespace rendering::scans
