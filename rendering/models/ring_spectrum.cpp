#include "rendering/models/ring_spectrum.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rendering::models {

namespace {

double lowestFrequency(int side) { return 1.5 / side; }
double ringRatio(int side) { return std::pow(0.5 / lowestFrequency(side), 1.0 / ringCount); }

/// Which ring a frequency in cycles a pixel lies in; fractional, 0 is the lower edge of the first.
double ringAt(double frequency, int side) { return std::log(frequency / lowestFrequency(side)) / std::log(ringRatio(side)); }

cv::Mat hannWindow(int side)
{
    cv::Mat line(1, side, CV_32F);
    for (int i = 0; i < side; ++i)
        line.at<float>(i) = static_cast<float>(0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / side));
    return line.t() * line;
}

double frequencyAt(int row, int column, const cv::Size& size)
{
    const double down = std::min(row, size.height - row) / static_cast<double>(size.height);
    const double right = std::min(column, size.width - column) / static_cast<double>(size.width);
    return std::hypot(down, right);
}

/// For every frequency of a window its ring, -1 outside all.
cv::Mat ringsOfWindow(int side)
{
    cv::Mat rings(side, side, CV_32S, cv::Scalar(-1));
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double frequency = frequencyAt(row, column, {side, side});
            if (frequency >= lowestFrequency(side) && frequency < 0.5)
                rings.at<int>(row, column) = std::min(ringCount - 1, static_cast<int>(ringAt(frequency, side)));
        }
    return rings;
}

void addPowers(const cv::Mat& part, const cv::Mat& window, cv::Mat& sums)
{
    cv::Mat centred = (part - cv::mean(part)[0]).mul(window), transform, planes[2];
    cv::dft(centred, transform, cv::DFT_COMPLEX_OUTPUT);
    cv::split(transform, planes);
    sums += planes[0].mul(planes[0]) + planes[1].mul(planes[1]);
}

/// Corners of windows that lie half over each other, the last one flush with the end.
std::vector<int> cornersAlong(int length, int side)
{
    std::vector<int> corners;
    for (int at = 0; at + side < length; at += side / 2)
        corners.push_back(at);
    corners.push_back(length - side);
    return corners;
}

cv::Mat atLeastAWindow(const cv::Mat& map, int side)
{
    if (map.rows >= side && map.cols >= side)
        return map;
    cv::Mat wide;
    cv::copyMakeBorder(map, wide, 0, std::max(0, side - map.rows), 0, std::max(0, side - map.cols), cv::BORDER_REFLECT);
    return wide;
}

bool firstRingIsEmpty(int side) { return cv::countNonZero(ringsOfWindow(side) == 0) == 0; }

constexpr int gainsPerCycle = 4096;

/// Gains between the rings' middles, by frequency in 1 / gainsPerCycle cycles a pixel up to a picture's corner.
std::vector<float> gainTable(const std::vector<double>& logGain, int side)
{
    std::vector<float> gains;
    for (int i = 0; i <= static_cast<int>(0.72 * gainsPerCycle); ++i) {
        const double frequency = (i + 0.5) / gainsPerCycle;
        const double place = std::clamp(ringAt(frequency, side) - 0.5, 0.0, ringCount - 1.0);
        const auto ring = std::min(static_cast<std::size_t>(place), logGain.size() - 2);
        const double share = place - static_cast<double>(ring);
        // Longer waves than the first ring's are no part of a press (there the sensor's low frequencies are removed) and fade out.
        const double fourth = std::pow(1.5 * frequency / lowestFrequency(side), 4);
        gains.push_back(static_cast<float>(fourth / (1 + fourth) * std::exp((1 - share) * logGain[ring] + share * logGain[ring + 1])));
    }
    return gains;
}

/// About its mean, mirrored by `border` px around, cut at 0.
cv::Mat filtered(const cv::Mat& heightMm, const std::vector<float>& gains, int mostBorder)
{
    const double mean = cv::mean(heightMm)[0];
    cv::Mat padded, transform;
    const int border = std::min({mostBorder, heightMm.rows - 1, heightMm.cols - 1});
    const auto beyond = [&](int length) { return cv::getOptimalDFTSize(length + 2 * border) - length - border; };
    cv::copyMakeBorder(heightMm - mean, padded, border, beyond(heightMm.rows), border, beyond(heightMm.cols), cv::BORDER_REFLECT_101);
    cv::dft(padded, transform, cv::DFT_COMPLEX_OUTPUT);
    for (int row = 0; row < transform.rows; ++row)
        for (int column = 0; column < transform.cols; ++column)
            transform.at<cv::Vec2f>(row, column) *=
                gains[static_cast<std::size_t>(frequencyAt(row, column, transform.size()) * gainsPerCycle)];
    cv::Mat result;
    cv::dft(transform, result, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    return cv::max(result({border, border, heightMm.cols, heightMm.rows}) + mean, 0);
}

}  // namespace

std::vector<float> ringPowers(const cv::Mat& heightMm, int side)
{
    const cv::Mat map = atLeastAWindow(heightMm, side), window = hannWindow(side);
    cv::Mat sums = cv::Mat::zeros(side, side, CV_32F);
    int windows = 0;
    for (const int row : cornersAlong(map.rows, side))
        for (const int column : cornersAlong(map.cols, side)) {
            addPowers(map({column, row, side, side}), window, sums);
            ++windows;
        }
    const double energy = cv::sum(window.mul(window))[0];
    const cv::Mat rings = ringsOfWindow(side);
    std::vector<double> total(ringCount), count(ringCount);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            if (const int ring = rings.at<int>(row, column); ring >= 0) {
                total[static_cast<std::size_t>(ring)] += sums.at<float>(row, column);
                count[static_cast<std::size_t>(ring)] += 1;
            }
    std::vector<float> powers(ringCount);
    for (std::size_t i = 0; i < powers.size(); ++i)
        powers[i] = count[i] > 0 ? static_cast<float>(std::log(total[i] / count[i] / (energy * windows) + ringFloorMm2))
                                 : powers[i > 0 ? i - 1 : 0];
    return powers;
}

cv::Mat withRingPowers(const cv::Mat& heightMm, const std::vector<float>& wanted, int side, double mostGain, int passes)
{
    std::vector<double> logGain(ringCount, 0);
    cv::Mat made = heightMm;
    for (int pass = 0; pass < passes; ++pass) {
        const std::vector<float> present = ringPowers(made, side);
        for (std::size_t i = 0; i < logGain.size(); ++i)
            logGain[i] = std::clamp(logGain[i] + 0.5 * static_cast<double>(wanted[i] - present[i]), -std::log(mostGain), std::log(mostGain));
        if (firstRingIsEmpty(side))
            logGain[0] = logGain[1];
        made = filtered(heightMm, gainTable(logGain, side), side / 2);
    }
    return made;
}

}  // namespace rendering::models
