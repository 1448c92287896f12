#include "rendering/models/seeing/told_shading.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/models/seeing/slow_relief.h"
#include "rendering/signals/linear_shading.h"

namespace rendering::models {

namespace {

/// Deviation of the added relief over that of the networks. A larger one sees more of scanned cloth that no training showed, and
/// less of drawn cloth, which the networks know.
constexpr double mostShading = 0.5;
constexpr double wholeShare = 0.1;  ///< the share of shading, above that of chance, from which on all of it is added
constexpr double mostTangent = 4;   ///< of the lamp's elevation: faint contrast is not enlarged beyond such a lamp

cv::Mat slowPart(const cv::Mat& relief)
{
    cv::Mat slow;
    cv::GaussianBlur(relief, slow, {}, slowSigmaPx, slowSigmaPx, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
    return slow;
}

double deviation(const cv::Mat& relief)
{
    cv::Scalar mean, spread;
    cv::meanStdDev(relief, mean, spread);
    return spread[0];
}

}  // namespace

cv::Mat withToldShading(const cv::Mat& reliefPx, const cv::Mat& contrast, double lightDeg)
{
    if (std::min(reliefPx.rows, reliefPx.cols) < signals::shadingWindowPx) return reliefPx.clone();
    const signals::LinearShading shading = signals::linearShading(contrast, lightDeg);
    const cv::Mat added = shading.relief - slowPart(shading.relief), slow = slowPart(reliefPx), fast = reliefPx - slow;
    const double ofNetworks = deviation(fast), ofShading = deviation(added);
    if (!(ofShading > 0)) return reliefPx.clone();
    const double trust = std::clamp((shading.shadingShare - shading.chanceShare) / wholeShare, 0.0, 1.0);
    const double weight = std::min(mostTangent, mostShading * trust * ofNetworks / ofShading);
    if (!(weight > 0)) return reliefPx.clone();
    const cv::Mat joined = fast + weight * added;
    const double ofJoined = deviation(joined);
    if (!(ofJoined > 0)) return reliefPx.clone();
    return slow + ofNetworks / ofJoined * joined;
}

}  // namespace rendering::models
