#include "study/evaluation/identification.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace study::evaluation {

namespace {

// Floors of the logarithms, far below the values of any fabric and far above rounding errors.
constexpr double powerFloor = 1e-12, sqFloorMm = 1e-6, sdrFloor = 1e-9, salFloorMm = 1e-4, meanFloor = 1e-4,
                 texturePowerFloor = 1e-10;

FeatureVector meanOf(const std::vector<FeatureVector>& samples)
{
    FeatureVector mean(samples.front().size());
    for (const FeatureVector& sample : samples)
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += sample[i] / static_cast<double>(samples.size());
    return mean;
}

using Classes = std::vector<std::vector<FeatureVector>>;

/// The samples whose signals were large enough for all features.
Classes withAllFeatures(Classes classes)
{
    std::size_t longest = 0;
    for (const auto& samples : classes)
        for (const FeatureVector& sample : samples) longest = std::max(longest, sample.size());
    for (auto& samples : classes) std::erase_if(samples, [&](const FeatureVector& sample) { return sample.size() < longest; });
    return classes;
}

cv::Mat difference(const FeatureVector& a, const FeatureVector& b)
{
    cv::Mat result(static_cast<int>(a.size()), 1, CV_64F);
    for (std::size_t i = 0; i < a.size(); ++i) result.at<double>(static_cast<int>(i)) = a[i] - b[i];
    return result;
}

}  // namespace

FeatureVector featureVector(const HeightFeatures& features)
{
    FeatureVector vector;
    for (const double power : features.bandPowers) vector.push_back(std::log10(power + powerFloor));
    vector.push_back(std::log10(features.sqMm + sqFloorMm));
    vector.push_back(std::log10(features.sdr + sdrFloor));
    vector.push_back(std::log10(features.salMm + salFloorMm));
    return vector;
}

FeatureVector featureVector(const FrictionFeatures& features)
{
    FeatureVector vector{std::log10(std::max(features.mean, meanFloor))};
    for (const double power : features.bandPowers) vector.push_back(std::log10(power + texturePowerFloor));
    return vector;
}

Identifier::Identifier(const std::vector<std::vector<FeatureVector>>& samplesOfClass)
{
    const Classes classes = withAllFeatures(samplesOfClass);
    std::size_t length = 0, count = 0;
    for (const auto& samples : classes) {
        m_means.push_back(samples.empty() ? FeatureVector{} : meanOf(samples));
        if (samples.empty()) continue;
        length = samples.front().size();
        count += samples.size();
        ++m_classes;
    }
    if (m_classes < 2) return;
    const auto size = static_cast<int>(length);
    cv::Mat covariance = cv::Mat::zeros(size, size, CV_64F);
    for (std::size_t k = 0; k < classes.size(); ++k)
        for (const FeatureVector& sample : classes[k]) {
            const cv::Mat from = difference(sample, m_means[k]);
            covariance += from * from.t();
        }
    const double freedom = static_cast<double>(count - m_classes);
    if (freedom > 0) covariance /= freedom;
    const double shrinkage = static_cast<double>(length) / (static_cast<double>(length) + freedom);
    cv::Mat shrunk = covariance * (1 - shrinkage);
    const double least =
        freedom > 0 ? 1e-6 * cv::trace(covariance)[0] / size + 1e-12 : 1;  // with one sample per class: Euclidean distance
    for (int i = 0; i < size; ++i) shrunk.at<double>(i, i) = covariance.at<double>(i, i) + least;
    cv::invert(shrunk, m_precision, cv::DECOMP_CHOLESKY);
}

std::optional<std::size_t> Identifier::classOf(const FeatureVector& features) const
{
    if (m_classes < 2 || static_cast<int>(features.size()) != m_precision.rows) return {};
    std::optional<std::size_t> best;
    double nearest = 0;
    for (std::size_t k = 0; k < m_means.size(); ++k) {
        if (m_means[k].empty()) continue;
        const cv::Mat from = difference(features, m_means[k]);
        const double distance = from.dot(m_precision * from);
        if (!best || distance < nearest) {
            best = k;
            nearest = distance;
        }
    }
    return best;
}

}  // namespace study::evaluation
