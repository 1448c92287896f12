// JPEG and whatever else Qt's image formats read, for readers that are lent a decoder. Needs a QCoreApplication
// (Surroundings::Core), through which Qt finds its formats.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace study::looking {

/// CV_8UC3, R, G, B; upright by the camera's orientation mark. Throws badInput.
cv::Mat decodeByQt(const std::filesystem::path& file);

}  // namespace study::looking
