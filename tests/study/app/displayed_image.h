// What a folder display shows now, for tests of sessions with a display.
#pragma once

#include <QString>
#include <opencv2/core.hpp>

#include "rendering/images/image_io.h"

namespace tests {

/// Pixel value of the displayed image, which is uniform in these studies; -1 if it is not.
inline int displayedIn(const QString& folder)
{
    const cv::Mat image = rendering::readPgm((folder + "/current.pgm").toStdString());
    double low = 0, high = 0;
    cv::minMaxLoc(image, &low, &high);
    return low == high ? static_cast<int>(low) : -1;
}

}  // namespace tests
