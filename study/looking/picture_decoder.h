// A decoder for JPEG and the other image formats of Qt. The readers in rendering/ take it as a function. It needs a
// QCoreApplication, through which Qt finds its formats.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace study::looking {

/// CV_8UC3 in the order R, G, B, turned upright by the orientation mark of the camera. The content decides on the format,
/// not the name: PNG, JPEG, BMP, GIF, PPM, PGM, PBM, and WebP or HEIF where Qt has it. Throws badInput, also for another format,
/// and for a JPEG or BMP that lacks its end.
cv::Mat decodeByQt(const std::filesystem::path& file);

}  // namespace study::looking
