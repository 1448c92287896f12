#include "study/evaluation/pixel_ridge.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/random.h"
#include "rendering/signals/grey.h"

namespace study::evaluation {

namespace {

constexpr double ridgePenalty = 1e-3;  ///< of the mean diagonal

cv::Mat standardised(const cv::Mat& map)
{
    const cv::Mat texture = highPassed(map, usualHighPassPx);
    cv::Scalar mean, spread;
    cv::meanStdDev(texture, mean, spread);
    return spread[0] > 0 ? cv::Mat((texture - mean[0]) / spread[0]) : cv::Mat(texture - mean[0]);
}

cv::Mat inner(const cv::Mat& map, double marginPx)
{
    const int margin = std::min({int(std::ceil(marginPx)), (map.rows - 1) / 4, (map.cols - 1) / 4});
    return map(cv::Rect(margin, margin, map.cols - 2 * margin, map.rows - 2 * margin));
}

}  // namespace

cv::Mat highPassed(const cv::Mat& map, double sigmaPx)
{
    cv::Mat values, smooth;
    map.convertTo(values, CV_32F);
    cv::GaussianBlur(values, smooth, {}, sigmaPx, sigmaPx, cv::BORDER_REFLECT);
    return values - smooth;
}

double reliefCorrelation(const cv::Mat& relief, const cv::Mat& surface, double sigmaPx)
{
    cv::Mat a, b;
    inner(highPassed(relief, sigmaPx), sigmaPx).convertTo(a, CV_64F);
    inner(highPassed(surface, sigmaPx), sigmaPx).convertTo(b, CV_64F);
    a -= cv::mean(a);
    b -= cv::mean(b);
    const double spread = std::sqrt(a.dot(a) * b.dot(b));
    return spread > 0 ? a.dot(b) / spread : 0;
}

RidgeSums::RidgeSums() : m_squares(cv::Mat::zeros(inputs, inputs, CV_64FC1)), m_products(cv::Mat::zeros(inputs, 1, CV_64FC1)) {}

void RidgeSums::add(const cv::Mat& photograph, const cv::Mat& surface, int samples, std::uint64_t seed)
{
    const cv::Mat pixels = standardised(rendering::signals::grey(photograph)), heights = standardised(surface);
    cv::Mat windows(samples, inputs, CV_32FC1), targets(samples, 1, CV_32FC1);
    protocols::Random random(seed);
    for (int i = 0; i < samples; ++i) {
        const int x = int(random.below(std::uint64_t(pixels.cols - windowPx + 1)));
        const int y = int(random.below(std::uint64_t(pixels.rows - windowPx + 1)));
        pixels(cv::Rect(x, y, windowPx, windowPx)).clone().reshape(1, 1).copyTo(windows.row(i));
        targets.at<float>(i) = heights.at<float>(y + windowPx / 2, x + windowPx / 2);
    }
    cv::Mat squares, products;
    cv::mulTransposed(windows, squares, true, cv::noArray(), 1, CV_64F);
    windows.convertTo(windows, CV_64F);
    targets.convertTo(targets, CV_64F);
    cv::gemm(windows, targets, 1, cv::noArray(), 0, products, cv::GEMM_1_T);
    m_squares += squares;
    m_products += products;
}

RidgeSums& RidgeSums::operator+=(const RidgeSums& other)
{
    m_squares += other.m_squares;
    m_products += other.m_products;
    return *this;
}

cv::Mat RidgeSums::weights() const
{
    const double penalty = ridgePenalty * cv::trace(m_squares)[0] / inputs;
    const cv::Mat system = m_squares + std::max(penalty, 1e-12) * cv::Mat::eye(inputs, inputs, CV_64FC1);
    cv::Mat solution, window;
    cv::solve(system, m_products, solution, cv::DECOMP_CHOLESKY);
    solution.reshape(1, windowPx).convertTo(window, CV_32F);
    return window;
}

cv::Mat ridgeRelief(const cv::Mat& photograph, const cv::Mat& weights)
{
    cv::Mat relief;
    cv::filter2D(standardised(rendering::signals::grey(photograph)), relief, CV_32F, weights, {-1, -1}, 0, cv::BORDER_REFLECT);
    return relief;
}

}  // namespace study::evaluation
