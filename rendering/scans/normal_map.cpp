#include "rendering/scans/normal_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/signals/periodic_slopes.h"

namespace rendering::scans {

namespace {

constexpr double leastZ = 0.0995;         ///< a slope of 10
constexpr double leastMeanZ = 0.5;        ///< tangent normals point out of the surface
constexpr double mostTilt = 0.1;          ///< of the mean normal
constexpr double mostLengthError = 0.15;  ///< of the mean length; beyond, blue holds something else
constexpr double clearCorrelation = 0.3, clearGap = 0.1;
constexpr double highPassPx = 16;

/// Means over the pixels of x, y, z, z squared and the length.
struct NormalFacts {
    double x = 0, y = 0, z = 0, zSquare = 0, length = 0;
    bool hasBlue() const { return std::abs(length - 1) <= mostLengthError && z >= leastMeanZ; }
    /// Blue is empty or full, and the other two channels are centred: z follows from the length 1.
    bool lacksBlue() const
    {
        return zSquare - z * z < 1e-4 && std::abs(z) > 0.9 && std::abs(x) < mostTilt && std::abs(y) < mostTilt;
    }
};

template <class Pixel>
NormalFacts factsOf(const cv::Mat& normals, double largest)
{
    NormalFacts facts;
    const double share = 1 / double(normals.total());
    for (const auto& pixel : cv::Mat_<Pixel>(normals)) {
        const double x = 2 * pixel[0] / largest - 1, y = 2 * pixel[1] / largest - 1, z = 2 * pixel[2] / largest - 1;
        facts.x += share * x;
        facts.y += share * y;
        facts.z += share * z;
        facts.zSquare += share * z * z;
        facts.length += share * std::sqrt(x * x + y * y + z * z);
    }
    return facts;
}

template <class Pixel>
signals::Slopes slopesOf(const cv::Mat& normals, double largest, bool useBlue)
{
    signals::Slopes slopes{cv::Mat(normals.size(), CV_32FC1), cv::Mat(normals.size(), CV_32FC1)};
    for (int row = 0; row < normals.rows; ++row) {
        const Pixel* pixel = normals.ptr<Pixel>(row);
        for (int column = 0; column < normals.cols; ++column) {
            const double x = 2 * pixel[column][0] / largest - 1, y = 2 * pixel[column][1] / largest - 1;
            const double z =
                std::max(leastZ, useBlue ? 2 * pixel[column][2] / largest - 1 : std::sqrt(std::max(0.0, 1 - x * x - y * y)));
            slopes.x.at<float>(row, column) = static_cast<float>(std::clamp(-x / z, -10.0, 10.0));
            slopes.y.at<float>(row, column) = static_cast<float>(std::clamp(y / z, -10.0, 10.0));
        }
    }
    return slopes;
}

template <class Pixel>
signals::Slopes checkedSlopes(const cv::Mat& normals, double largest, const std::string& where)
{
    const NormalFacts facts = factsOf<Pixel>(normals, largest);
    if (facts.hasBlue() || facts.lacksBlue()) return slopesOf<Pixel>(normals, largest, !facts.lacksBlue());
    throw protocols::badInput(
        {"is no tangent normal map (its normals point out of the surface by " + protocols::fixed(facts.z, 2) + " on average)",
         where, "RGB near 128, 128, 255 where the cloth is flat", "choose the normal map of the fabric"});
}

cv::Mat withoutLongWaves(const cv::Mat& heights)
{
    cv::Mat smooth;
    cv::GaussianBlur(heights, smooth, {}, highPassPx, highPassPx, cv::BORDER_REFLECT | cv::BORDER_ISOLATED);
    return heights - smooth;
}

cv::Mat broughtTo(const cv::Mat& heights, cv::Size size)
{
    if (heights.size() == size) return heights;
    cv::Mat result;
    cv::resize(heights, result, size, 0, 0, cv::INTER_AREA);
    return result;
}

/// The heights at this size without long waves, mean 0, CV_64FC1; 0 everywhere where only rounding is left of them.
cv::Mat shortWaves(const cv::Mat& heights, cv::Size size)
{
    constexpr double rounding = 1e-6;  // of single precision, after some sums
    cv::Mat waves;
    withoutLongWaves(broughtTo(heights, size)).convertTo(waves, CV_64F);
    waves -= cv::mean(waves);
    const double least = rounding * cv::norm(heights, cv::NORM_INF) * std::sqrt(double(waves.total()));
    return cv::norm(waves) > least ? waves : cv::Mat::zeros(waves.size(), CV_64FC1);
}

}  // namespace

signals::Slopes slopesOfNormals(const cv::Mat& normals, const std::string& where)
{
    if (normals.type() == CV_8UC3) return checkedSlopes<cv::Vec3b>(normals, 255, where);
    if (normals.type() == CV_16UC3) return checkedSlopes<cv::Vec<ushort, 3>>(normals, 65535, where);
    throw protocols::badInput({"has " + std::to_string(normals.channels()) + " channels", where,
                               "a normal map in RGB of 8 or 16 bits", "choose the normal map of the fabric"});
}

double heightCorrelation(const cv::Mat& a, const cv::Mat& b)
{
    const cv::Size size = a.total() < b.total() ? a.size() : b.size();
    const cv::Mat first = shortWaves(a, size), second = shortWaves(b, size);
    const double spread = cv::norm(first) * cv::norm(second);
    return spread > 0 ? std::clamp(first.dot(second) / spread, -1.0, 1.0) : 0;
}

GreenSign greenSignOf(const signals::Slopes& slopes, const cv::Mat& displacement, GreenUp stated)
{
    const signals::SlopeAgreement agreement = signals::slopeAgreement(slopes);
    GreenSign sign{true, "slopes agree at " + protocols::fixed(std::abs(agreement.agreement), 2)};
    if (!displacement.empty()) {
        const double up = heightCorrelation(signals::integratePeriodic(slopes, {1, 1}), displacement);
        const double down = heightCorrelation(signals::integratePeriodic({slopes.x, -slopes.y}, {1, 1}), displacement);
        sign.remark += ", displacement correlates at " + protocols::fixed(up, 2) + " with green up and at " +
                       protocols::fixed(down, 2) + " with green down";
        const double larger = std::max(std::abs(up), std::abs(down)), gap = std::abs(std::abs(up) - std::abs(down));
        if (larger >= clearCorrelation && gap >= clearGap) {
            sign.isUp = std::abs(up) > std::abs(down);
            return sign;
        }
    }
    if (agreement.isClear()) {
        sign.isUp = agreement.agreement > 0;
        return sign;
    }
    sign.isUp = stated != GreenUp::No;
    sign.remark += stated == GreenUp::Unstated ? "; this decides nothing, so green is taken as up: check a picture of the relief"
                                               : "; this decides nothing, so the file name does";
    return sign;
}

}  // namespace rendering::scans
