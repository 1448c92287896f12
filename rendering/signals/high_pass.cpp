#include "rendering/signals/high_pass.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "protocols/files/errors.h"
#include "rendering/signals/cosine_transform.h"

namespace rendering::signals {

cv::Mat highPassShares(cv::Size size, const Pitch& pitch, double cutoffMm)
{
    if (!(cutoffMm > 0))
        throw protocols::badInput({.what = "a high-pass cut-off of " + std::to_string(cutoffMm) + " mm removes nothing",
                                   .where = "",
                                   .expected = "a wavelength above 0",
                                   .nextStep = "correct the cut-off"});
    const auto removed = [cutoffMm](int length, double step) {
        std::vector<double> share(static_cast<std::size_t>(length));
        for (int k = 0; k < length; ++k)
            share[static_cast<std::size_t>(k)] = std::exp2(-std::pow(cutoffMm * cosineFrequency(k, length, step), 2));
        return share;
    };
    const auto alongX = removed(size.width, pitch.x), alongY = removed(size.height, pitch.y);
    cv::Mat shares(size, CV_64FC1);
    for (int i = 0; i < size.height; ++i)
        for (int j = 0; j < size.width; ++j)
            shares.at<double>(i, j) = 1 - alongY[static_cast<std::size_t>(i)] * alongX[static_cast<std::size_t>(j)];
    return shares;
}

}  // namespace rendering::signals
