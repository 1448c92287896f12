#include "rendering/fabrics/drawn/jpeg_loss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace rendering::fabrics {

namespace {

constexpr int block = 8;
using Block = std::array<float, block * block>;

constexpr std::array<int, 64> lumaTable = {16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,
                                           14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,
                                           18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,
                                           49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};
constexpr std::array<int, 64> chromaTable = {17, 18, 24, 47, 99, 99, 99, 99, 18, 21, 26, 66, 99, 99, 99, 99,
                                             24, 26, 56, 99, 99, 99, 99, 99, 47, 66, 99, 99, 99, 99, 99, 99,
                                             99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99,
                                             99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99};

Block cosines()
{
    Block table{};
    for (int k = 0; k < block; ++k)
        for (int n = 0; n < block; ++n)
            table[std::size_t(k * block + n)] =
                float((k == 0 ? std::sqrt(0.125) : 0.5) * std::cos((2 * n + 1) * k * std::numbers::pi / 16));
    return table;
}

Block scaledTable(const std::array<int, 64>& table, int quality)
{
    const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
    Block scaled{};
    for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] = float(std::clamp((table[i] * scale + 50) / 100, 1, 255));
    return scaled;
}

/// left · right, with 8 × 8 matrices; `turned` transposes left.
Block product(const Block& left, const Block& right, bool turnLeft, bool turnRight)
{
    Block result{};
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = 0; k < 8; ++k) {
            const float factor = turnLeft ? left[k * 8 + i] : left[i * 8 + k];
            for (std::size_t j = 0; j < 8; ++j) result[i * 8 + j] += factor * (turnRight ? right[j * 8 + k] : right[k * 8 + j]);
        }
    return result;
}

void compressPlane(cv::Mat& plane, const Block& steps)
{
    static const Block cosine = cosines();
    for (int top = 0; top + block <= plane.rows; top += block)
        for (int left = 0; left + block <= plane.cols; left += block) {
            Block values{};
            for (int y = 0; y < block; ++y)
                for (int x = 0; x < block; ++x) values[std::size_t(y * block + x)] = plane.at<float>(top + y, left + x);
            Block waves = product(product(cosine, values, false, false), cosine, false, true);
            for (std::size_t i = 0; i < waves.size(); ++i) waves[i] = steps[i] * std::nearbyint(waves[i] / steps[i]);
            const Block back = product(product(cosine, waves, true, false), cosine, false, false);
            for (int y = 0; y < block; ++y)
                for (int x = 0; x < block; ++x) plane.at<float>(top + y, left + x) = back[std::size_t(y * block + x)];
        }
}

int padded(int size, int step) { return (size + step - 1) / step * step; }

}  // namespace

cv::Mat afterJpeg(const cv::Mat& rgb, int quality)
{
    cv::Mat whole, planes[3], values;
    cv::copyMakeBorder(rgb, whole, 0, padded(rgb.rows, 2 * block) - rgb.rows, 0, padded(rgb.cols, 2 * block) - rgb.cols,
                       cv::BORDER_REPLICATE);
    whole.convertTo(values, CV_32F);
    cv::cvtColor(values, values, cv::COLOR_RGB2YCrCb);  // Float input: Cr and Cb are centred at 0.5.
    cv::split(values, planes);
    for (int c = 0; c < 3; ++c) {
        planes[c] -= c == 0 ? 128 : 0.5;
        if (c > 0) cv::resize(planes[c], planes[c], whole.size() / 2, 0, 0, cv::INTER_AREA);
        compressPlane(planes[c], scaledTable(c == 0 ? lumaTable : chromaTable, quality));
        if (c > 0) cv::resize(planes[c], planes[c], whole.size(), 0, 0, cv::INTER_LINEAR);
        planes[c] += c == 0 ? 128 : 0.5;
    }
    cv::merge(planes, 3, values);
    cv::cvtColor(values, values, cv::COLOR_YCrCb2RGB);
    values.convertTo(whole, CV_8U);
    return whole(cv::Rect(0, 0, rgb.cols, rgb.rows)).clone();
}

}  // namespace rendering::fabrics
