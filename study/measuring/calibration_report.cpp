#include "study/measuring/calibration_report.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/signals/tactile/photometric_stereo.h"

namespace study::measuring {

namespace signals = rendering::signals;

namespace {

constexpr std::size_t rowsOfSheet = 12;
constexpr int textPx = 20;

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

cv::Mat grey(const cv::Mat& heightMm, double from, double to)
{
    cv::Mat level, colour;
    heightMm.convertTo(level, CV_8U, 255 / (to - from), -255 * from / (to - from));
    cv::cvtColor(level, colour, cv::COLOR_GRAY2RGB);
    return colour;
}

/// Blue where too low, red where too high, white where exact.
cv::Mat signedColours(const cv::Mat& differenceMm, double mostMm)
{
    cv::Mat colour(differenceMm.size(), CV_8UC3);
    for (int i = 0; i < colour.rows; ++i)
        for (int j = 0; j < colour.cols; ++j) {
            const double share = std::clamp(differenceMm.at<float>(i, j) / mostMm, -1.0, 1.0);
            const auto fade = cv::saturate_cast<uchar>(255 * (1 - std::abs(share)));
            colour.at<cv::Vec3b>(i, j) = share < 0 ? cv::Vec3b(fade, fade, 255) : cv::Vec3b(255, fade, fade);
        }
    return colour;
}

cv::Mat enlarged(const cv::Mat& image, int factor)
{
    cv::Mat large;
    cv::resize(image, large, {}, factor, factor, cv::INTER_NEAREST);
    return large;
}

cv::Mat eightBit(const cv::Mat& frame)
{
    cv::Mat result;
    frame.convertTo(result, CV_8U, frame.depth() == CV_16U ? 1 / 257.0 : 1);
    return result;
}

void write(cv::Mat& sheet, const std::string& text, int x, int y)
{
    cv::putText(sheet, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.45, cv::Scalar(20, 20, 20), 1, cv::LINE_AA);
}

cv::Mat rowOf(const signals::BallPresses& presses, const signals::Calibration& calibration, const signals::PressScore& score)
{
    const auto press =
        std::find_if(presses.presses.begin(), presses.presses.end(), [&](const auto& p) { return p.name == score.name; });
    const int factor = std::max(1, 320 / press->frame.cols);
    cv::Mat frame = enlarged(eightBit(press->frame), factor);
    cv::circle(frame,
               {static_cast<int>(std::lround((score.circle.centrePx.x + 0.5) * factor)),
                static_cast<int>(std::lround((score.circle.centrePx.y + 0.5) * factor))},
               static_cast<int>(std::lround(score.circle.radiusPx * factor)), cv::Scalar(255, 255, 255), 1, cv::LINE_AA);
    const cv::Mat known = signals::ballHeight(presses, score.circle), contact = known > 0;
    const auto slopes = signals::slopesFromFrame(press->frame, presses.background, calibration);
    const cv::Mat found = signals::heightInContact(slopes, contact, {presses.mmPerPixel, presses.mmPerPixel});
    double top = 0;
    cv::minMaxLoc(known, nullptr, &top);
    cv::Mat row;
    cv::hconcat(
        std::vector<cv::Mat>{frame, enlarged(grey(found, 0, 1.3 * top), factor), enlarged(grey(known, 0, 1.3 * top), factor),
                             enlarged(signedColours(found - known, 0.3 * top), factor)},
        row);
    cv::Mat labelled(row.rows + textPx, row.cols, CV_8UC3, cv::Scalar::all(255));
    row.copyTo(labelled.rowRange(textPx, labelled.rows));
    char text[200];
    std::snprintf(
        text, sizeof text,
        "%s: contact %.1f px; normals %.1f deg, depth %.3f mm off; peak %.2f of %.2f mm; white: right, red +%.2f, blue -%.2f mm",
        score.name.c_str(), score.circle.radiusPx, score.normalErrorDeg, score.depthErrorMm, score.peakMm, top, 0.3 * top,
        0.3 * top);
    write(labelled, text, 4, 14);
    return labelled;
}

}  // namespace

std::string nameOf(signals::MapQuality quality)
{
    switch (quality) {
        case signals::MapQuality::Fast:
            return "fast";
        case signals::MapQuality::Balanced:
            return "balanced";
        case signals::MapQuality::Accurate:
            return "accurate";
    }
    return {};
}

QualityTrade tradeOf(const signals::BallPresses& presses, const signals::LocatedPresses& located, signals::MapQuality quality)
{
    QualityTrade trade{quality, signals::crossValidated(presses, located.circles, quality), 0, 0};
    std::vector<std::size_t> all(presses.presses.size());
    std::iota(all.begin(), all.end(), 0);
    auto start = std::chrono::steady_clock::now();
    const auto calibration = signals::calibrationFrom(presses, located.circles, all, quality);
    trade.fitSeconds = secondsSince(start);
    constexpr int repeats = 5;
    start = std::chrono::steady_clock::now();
    for (int i = 0; i < repeats; ++i) signals::slopesFromFrame(presses.presses.front().frame, presses.background, calibration);
    trade.millisecondsAFrame = 1000 * secondsSince(start) / repeats;
    return trade;
}

nlohmann::ordered_json jsonOf(const signals::CalibrationScore& score)
{
    nlohmann::ordered_json presses = nlohmann::ordered_json::array();
    for (const auto& press : score.presses)
        presses.push_back({{"file", press.name},
                           {"centre_px", {press.circle.centrePx.x, press.circle.centrePx.y}},
                           {"radius_px", press.circle.radiusPx},
                           {"explained", press.circle.explained},
                           {"normal_error_deg", press.normalErrorDeg},
                           {"depth_error_mm", press.depthErrorMm},
                           {"peak_mm", press.peakMm},
                           {"peak_over_gel_mm", press.peakOverGelMm}});
    return {{"normal_error_deg", score.normalErrorDeg},
            {"depth_error_mm", score.depthErrorMm},
            {"peak_mm", score.peakMm},
            {"peak_range_mm", {score.lowestPeakMm, score.highestPeakMm}},
            {"ball_peak_mm", score.ballPeakMm},
            {"peak_over_gel_mm", score.peakOverGelMm},
            {"presses", presses}};
}

cv::Mat pressSheet(const signals::BallPresses& presses, const signals::Calibration& calibration,
                   const signals::CalibrationScore& score)
{
    auto worst = score.presses;
    std::sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a.depthErrorMm > b.depthErrorMm; });
    if (worst.size() > rowsOfSheet) worst.resize(rowsOfSheet);
    std::vector<cv::Mat> rows;
    for (const auto& press : worst) rows.push_back(rowOf(presses, calibration, press));
    cv::Mat sheet, all;
    cv::vconcat(rows, all);
    sheet = cv::Mat(all.rows + textPx, all.cols, CV_8UC3, cv::Scalar::all(255));
    all.copyTo(sheet.rowRange(textPx, sheet.rows));
    const int column = all.cols / 4;
    const char* const heads[] = {"frame, circle found", "height found", "height of the ball", "found - ball"};
    for (int i = 0; i < 4; ++i) write(sheet, heads[i], 4 + i * column, 14);
    return sheet;
}

}  // namespace study::measuring
