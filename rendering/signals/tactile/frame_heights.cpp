#include "rendering/signals/tactile/frame_heights.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "rendering/signals/cosine_transform.h"
#include "rendering/signals/high_pass.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering::signals {

namespace {

constexpr int levels = 4096;

cv::Mat factorsFor(const SlopeDifferences<float>& differences, cv::Size size, const Calibration& calibration)
{
    const Pitch pitch{calibration.mmPerPixel, calibration.mmPerPixel};
    cv::Mat factors = differences.heightFactors();
    if (!calibration.highPassCutoffMm) return factors;
    cv::Mat shares;
    highPassShares(size, pitch, *calibration.highPassCutoffMm).convertTo(shares, CV_32F);
    return factors.mul(shares);
}

/// The height that `percent` of the pixels do not exceed, from a histogram. A sample of every few pixels would see a few phases
/// of a weave only.
double lowPercentile(const cv::Mat& height, double percent, std::vector<int>& counts)
{
    double least = 0, most = 0;
    cv::minMaxLoc(height, &least, &most);
    if (!(most > least)) return least;
    counts.assign(levels, 0);
    const auto low = static_cast<float>(least), scale = static_cast<float>((levels - 1) / (most - least));
    for (int i = 0; i < height.rows; ++i) {
        const float* row = height.ptr<float>(i);
        for (int j = 0; j < height.cols; ++j)  // a calibration of extremes leaves heights that are no numbers
            if (const float level = (row[j] - low) * scale; level >= 0 && level < levels)
                ++counts[static_cast<std::size_t>(level)];
    }
    const double wanted = percent / 100 * static_cast<double>(height.total() - 1);
    double below = 0;
    int level = 0;
    while (level + 1 < levels && below + counts[static_cast<std::size_t>(level)] <= wanted)
        below += counts[static_cast<std::size_t>(level++)];
    return least + (level + 0.5) * (most - least) / (levels - 1);
}

}  // namespace

FrameHeights::FrameHeights(const Calibration& calibration, const cv::Mat& reference)
    : m_calibration(calibration),
      m_reference(reference),
      m_differences(reference.size(), {calibration.mmPerPixel, calibration.mmPerPixel}, SlopeKind::Point)
{
    if (reference.empty())
        throw protocols::badInput({.what = "the frame of the untouched sensor is empty",
                                   .where = "",
                                   .expected = "an image of the size of the frames",
                                   .nextStep = "use the reference frame of the same sensor"});
    m_factors = factorsFor(m_differences, reference.size(), calibration);
}

const cv::Mat& FrameHeights::heightOf(const cv::Mat& frame)
{
    cv::Mat spectrum = cosineTransform(m_differences.sources(slopesFromFrame(frame, m_reference, m_calibration)));
    cv::multiply(spectrum, m_factors, spectrum);
    m_height = inverseCosineTransform(spectrum);
    cv::subtract(m_height, lowPercentile(m_height, m_calibration.zeroPercentile, m_counts), m_height);
    cv::max(m_height, 0, m_height);
    return m_height;
}

}  // namespace rendering::signals
