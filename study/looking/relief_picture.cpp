#include "study/looking/relief_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace study::looking {

namespace {

constexpr double foreshortening = 0.62;  // height of the ground over its depth, viewed from about 40 degrees above
constexpr double heightShare = 0.11;     // share of the picture's height for the relief
constexpr double outlierShare = 0.005;   // ignored at each end, so that one spike does not flatten the rest

/// Range of the values without outliers.
std::pair<double, double> bulkOf(const cv::Mat& values)
{
    std::vector<float> finite;
    for (const float value : cv::Mat_<float>(values))
        if (std::isfinite(value)) finite.push_back(value);
    if (finite.empty()) return {0, 0};
    const auto at = [&](double share) {
        const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(finite.size() - 1));
        std::nth_element(finite.begin(), finite.begin() + place, finite.end());
        return static_cast<double>(finite[static_cast<std::size_t>(place)]);
    };
    return {at(outlierShare), at(1 - outlierShare)};
}

/// Heights in pixels of the picture, resampled to its columns.
cv::Mat heightsFor(const cv::Mat& values, int width, int rows, double low, double high, double pixelsPerUnit)
{
    cv::Mat whole = values.clone(), resized;
    cv::patchNaNs(whole, low);
    whole = cv::min(cv::max(whole, low), high) - low;
    const bool isSmaller = width < whole.cols || rows < whole.rows;
    const int way = isSmaller ? cv::INTER_AREA : (whole.cols < 12 || whole.rows < 12) ? cv::INTER_NEAREST : cv::INTER_LINEAR;
    cv::resize(whole, resized, {width, rows}, 0, 0, way);
    return resized * pixelsPerUnit;
}

/// Brightness of a point under a light from the upper left, 0..1.1.
double brightnessAt(const cv::Mat& heights, int row, int column)
{
    const auto at = [&](int r, int c) {
        return heights.at<float>(std::clamp(r, 0, heights.rows - 1), std::clamp(c, 0, heights.cols - 1));
    };
    // Slopes are compressed, because steep sides of fine threads would be only black and white.
    const auto eased = [](double slope) { return slope / (1 + 0.6 * std::abs(slope)); };
    const double dx = eased((at(row, column + 1) - at(row, column - 1)) / 2);
    const double dy = eased((at(row + 1, column) - at(row - 1, column)) / 2 * foreshortening);
    const std::array<double, 3> light{-0.62, -0.24, 0.75};  // the y axis points to the viewer
    const double lambert = (-dx * light[0] - dy * light[1] + light[2]) / std::sqrt(dx * dx + dy * dy + 1);
    return 0.3 + 0.82 * std::max(0.0, lambert);
}

QRgb lit(const QColor& body, double brightness)
{
    const auto channel = [&](int value) { return static_cast<int>(std::clamp(value * brightness, 0.0, 255.0)); };
    return qRgb(channel(body.red()), channel(body.green()), channel(body.blue()));
}

}  // namespace

QColor colourOf(double fraction)
{
    constexpr std::array<std::array<double, 3>, 5> stops{
        {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
    const double place = std::clamp(fraction, 0.0, 1.0) * (stops.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double part = place - static_cast<double>(low);
    const auto mixed = [&](std::size_t channel) {
        return static_cast<int>(std::lround(stops[low][channel] + part * (stops[low + 1][channel] - stops[low][channel])));
    };
    return QColor(mixed(0), mixed(1), mixed(2));
}

QImage pictureOf(const cv::Mat& values, double low, double high, Palette palette, const QColor& missing)
{
    std::array<QRgb, 256> table{};
    for (int level = 0; level < 256; ++level)
        table[static_cast<std::size_t>(level)] =
            palette == Palette::Grey ? qRgb(level, level, level) : colourOf(level / 255.0).rgb();
    QImage picture(values.cols, values.rows, QImage::Format_RGB32);
    const double scale = high > low ? 255 / (high - low) : 0;
    for (int row = 0; row < values.rows; ++row) {
        auto* line = reinterpret_cast<QRgb*>(picture.scanLine(row));
        for (int column = 0; column < values.cols; ++column) {
            const double value = values.at<float>(row, column);
            const double level = std::clamp((value - low) * scale, 0.0, 255.0);
            line[column] = std::isfinite(value) ? table[static_cast<std::size_t>(level + 0.5)] : missing.rgb();
        }
    }
    return picture;
}

QRect reliefPart(const cv::Mat& values, double widthOverDepth)
{
    const int widest = std::max(128, values.cols / 8);
    const int width = std::min(values.cols, widest);
    const int depth = std::clamp(static_cast<int>(std::lround(width / widthOverDepth)), 1, values.rows);
    return {(values.cols - width) / 2, (values.rows - depth) / 2, width, depth};
}

ReliefPicture reliefOf(const cv::Mat& values, QSize size, const QColor& body)
{
    const auto [low, high] = bulkOf(values);
    ReliefPicture relief{QImage(size, QImage::Format_ARGB32_Premultiplied), 0, static_cast<double>(size.width()) / values.cols};
    relief.picture.fill(Qt::transparent);
    const double highest = heightShare * size.height();
    relief.pixelsPerUnit = high > low ? highest / (high - low) : 0;
    const int edge = std::max(2, size.height() / 24);  // front side of the block
    const int ground = size.height() - edge - static_cast<int>(std::ceil(highest));
    // The ground keeps the proportions of the map if they fit, otherwise it uses the available depth.
    const int rows =
        std::clamp(static_cast<int>(std::lround(relief.pixelsPerValue * values.rows * foreshortening)), 1, std::max(1, ground));
    const cv::Mat heights = heightsFor(values, size.width(), rows, low, high, relief.pixelsPerUnit);
    const int bottom = size.height() - edge;
    for (int x = 0; x < size.width(); ++x) {
        int hidden = size.height();  // everything from this line down is already drawn
        const QRgb front = lit(body, 0.32);
        for (int row = rows - 1; row >= 0; --row) {
            const int y = std::clamp(bottom - (rows - 1 - row) - static_cast<int>(std::lround(heights.at<float>(row, x))), 0,
                                     size.height() - 1);
            const QRgb shade = row == rows - 1 ? front : lit(body, brightnessAt(heights, row, x));
            for (int line = y; line < hidden; ++line) reinterpret_cast<QRgb*>(relief.picture.scanLine(line))[x] = shade;
            hidden = std::min(hidden, y);
        }
    }
    return relief;
}

}  // namespace study::looking
