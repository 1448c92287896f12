// Places that a periodic picture shows twice: a patch that was copied to hide a fault, or a pattern that repeats exactly.
// A split by place would then test on what was trained.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace rendering::signals {

struct RepeatedPlace {
    double match = 0;             ///< largest correlation of a window with its copy
    double share = 0;             ///< share of the picture whose windows match at least at 0.95
    int rightPx = 0, downPx = 0;  ///< where the copy lies
};

/// Searches a periodic picture (CV_32FC1) for a copy. Peaks of its power cepstrum are candidates; each is tested by the
/// correlation of windows of 33 px, without waves far longer than a window. Returns the candidate of the largest share, or
/// nullopt where no share reaches `leastShare`. Pictures of more than 1,400 px a side are reduced first.
std::optional<RepeatedPlace> repeatedPlace(const cv::Mat& picture, double leastShare = 0.002);

}  // namespace rendering::signals
