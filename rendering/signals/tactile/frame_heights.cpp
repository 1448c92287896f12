#include "rendering/signals/tactile/frame_heights.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "rendering/signals/cosine_transform.h"
#include "rendering/signals/high_pass.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering::signals {

namespace {

constexpr int sampleStep = 4;

cv::Mat factorsFor(const SlopeDifferences<float>& differences, cv::Size size, const Calibration& calibration)
{
    const Pitch pitch{calibration.mmPerPixel, calibration.mmPerPixel};
    cv::Mat factors = differences.heightFactors();
    if (!calibration.highPassCutoffMm) return factors;
    cv::Mat shares;
    highPassShares(size, pitch, *calibration.highPassCutoffMm).convertTo(shares, CV_32F);
    return factors.mul(shares);
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
    m_sample.clear();
    for (int i = 0; i < m_height.rows; i += sampleStep)
        for (int j = 0; j < m_height.cols; j += sampleStep) m_sample.push_back(m_height.at<float>(i, j));
    const auto place = static_cast<std::ptrdiff_t>(m_calibration.zeroPercentile / 100 * static_cast<double>(m_sample.size() - 1));
    std::nth_element(m_sample.begin(), m_sample.begin() + place, m_sample.end());
    cv::subtract(m_height, m_sample[static_cast<std::size_t>(place)], m_height);
    cv::max(m_height, 0, m_height);
    return m_height;
}

}  // namespace rendering::signals
