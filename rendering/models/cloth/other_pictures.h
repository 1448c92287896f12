// Pictures that are no cloth, drawn without end: overlapping leaves of all sizes (which have the statistics of natural scenes),
// landscapes, printed text, plain colours, soft clouds, and line drawings. They teach what is not cloth, and no picture of
// anybody is needed for it.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace rendering::models {

/// CV_8UC3, RGB, a square of 192 to 512 px. Equal arguments give the same picture.
cv::Mat drawOtherPicture(std::uint64_t seed, std::uint64_t index);

}  // namespace rendering::models
