#include "rendering/models/training_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace rendering::models {

namespace {

constexpr int cell = 192, gap = 8, labelWidth = 56, scaleWidth = 104, headHeight = 30;

void write(cv::Mat& sheet, const std::string& words, cv::Point where)
{
    cv::putText(sheet, words, where, cv::FONT_HERSHEY_SIMPLEX, 0.42, cv::Scalar::all(20), 1, cv::LINE_AA);
}

/// Draws a picture into a square of cell x cell and keeps its aspect ratio.
void place(cv::Mat& sheet, const cv::Mat& picture, cv::Point corner)
{
    const double factor = static_cast<double>(cell) / std::max(picture.cols, picture.rows);
    const auto side = [&](int length) { return std::clamp(static_cast<int>(std::lround(length * factor)), 1, cell); };
    cv::Mat scaled;
    cv::resize(picture, scaled, {side(picture.cols), side(picture.rows)}, 0, 0, factor < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
    scaled.copyTo(sheet({corner.x, corner.y, scaled.cols, scaled.rows}));
}

/// Least and greatest height of both maps, mm.
std::pair<double, double> commonRange(const SampleRow& row)
{
    double low = 0, high = 0;
    bool first = true;
    for (const cv::Mat& map : {row.trueHeightMm, row.generatedHeightMm})
        if (!map.empty()) {
            double least = 0, greatest = 0;
            cv::minMaxLoc(map, &least, &greatest);
            low = first ? least : std::min(low, least);
            high = first ? greatest : std::max(high, greatest);
            first = false;
        }
    return {low, high};
}

void placeHeight(cv::Mat& sheet, const cv::Mat& heightMm, std::pair<double, double> range, cv::Point corner)
{
    if (heightMm.empty()) {
        write(sheet, "not measured", {corner.x + 50, corner.y + cell / 2});
        return;
    }
    const double span = std::max(range.second - range.first, 1e-9);
    cv::Mat grey, colour;
    heightMm.convertTo(grey, CV_8U, 255 / span, -255 * range.first / span);
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2RGB);
    place(sheet, colour, corner);
}

/// "0.123 mm"
std::string millimetres(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3f mm", value);
    std::replace(text, text + sizeof text, ',', '.');
    return text;
}

/// Draws the scale from the least height (black, bottom) to the greatest (white, top).
void placeScale(cv::Mat& sheet, std::pair<double, double> range, cv::Point corner)
{
    for (int y = 0; y < cell; ++y) sheet({corner.x, corner.y + y, 14, 1}).setTo(cv::Scalar::all(255 - 255 * y / (cell - 1)));
    cv::rectangle(sheet, cv::Rect(corner.x, corner.y, 14, cell), cv::Scalar::all(120));
    write(sheet, millimetres(range.second), {corner.x + 19, corner.y + 12});
    write(sheet, millimetres(range.first), {corner.x + 19, corner.y + cell - 2});
}

}  // namespace

cv::Mat samplePicture(int step, std::span<const SampleRow> rows)
{
    const int width = labelWidth + 3 * (cell + gap) + scaleWidth;
    cv::Mat sheet(headHeight + static_cast<int>(rows.size()) * (cell + gap), width, CV_8UC3, cv::Scalar::all(255));
    const auto column = [](int number) { return labelWidth + number * (cell + gap); };
    write(sheet, "step " + std::to_string(step), {4, 13});
    const char* heads[] = {"photograph", "measured height", "generated height"};
    for (int i = 0; i < 3; ++i) write(sheet, heads[i], {column(i), 25});
    int y = headHeight;
    for (const SampleRow& row : rows) {
        write(sheet, row.label, {4, y + cell / 2});
        place(sheet, row.photograph, {column(0), y});
        const auto range = commonRange(row);
        placeHeight(sheet, row.trueHeightMm, range, {column(1), y});
        placeHeight(sheet, row.generatedHeightMm, range, {column(2), y});
        placeScale(sheet, range, {column(3), y});
        y += cell + gap;
    }
    return sheet;
}

}  // namespace rendering::models
