#include "rendering/signals/dominant_wave.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace rendering::signals {

namespace {

constexpr int largestWindow = 256, smallestWindow = 32, mostWindowsAlong = 8;
constexpr double shortestPeriodPx = 2.2;
constexpr double slowestSteps = 4;      ///< cycles per window
constexpr double waveWidthSteps = 1.6;  ///< half width of a wave under a Hann window

int windowSide(const cv::Mat& picture) { return std::min({picture.rows, picture.cols, largestWindow}) / 2 * 2; }

cv::Mat greyOf(const cv::Mat& picture)
{
    cv::Mat grey = picture;
    if (picture.channels() == 3) cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
    grey.convertTo(grey, CV_32F);
    return grey;
}

/// Corners of windows that overlap by half; a long picture has at most mostWindowsAlong of them.
std::vector<int> cornersAlong(int length, int side)
{
    const int room = length - side, wanted = std::clamp(2 * room / side + 1, 1, mostWindowsAlong);
    std::vector<int> corners;
    for (int i = 0; i < wanted; ++i) corners.push_back(wanted == 1 ? room / 2 : room * i / (wanted - 1));
    return corners;
}

cv::Mat powersOf(const cv::Mat& grey, int side)
{
    cv::Mat line(1, side, CV_32F);
    for (int i = 0; i < side; ++i) line.at<float>(i) = static_cast<float>(0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / side));
    const cv::Mat window = line.t() * line;
    cv::Mat powers = cv::Mat::zeros(side, side, CV_32F);
    for (const int row : cornersAlong(grey.rows, side))
        for (const int column : cornersAlong(grey.cols, side)) {
            const cv::Mat part = grey({column, row, side, side});
            cv::Mat transform, planes[2];
            cv::dft(cv::Mat((part - cv::mean(part)[0]).mul(window)), transform, cv::DFT_COMPLEX_OUTPUT);
            cv::split(transform, planes);
            powers += planes[0].mul(planes[0]) + planes[1].mul(planes[1]);
        }
    return powers;
}

/// Signed frequency of a row or column of a transform, in cycles per window.
int stepsOf(int index, int side) { return index <= side / 2 ? index : index - side; }

/// Searches half of the plane only, because the other half mirrors it.
bool isSearched(int down, int right, int side)
{
    const double steps = std::hypot(down, right);
    return (right > 0 || (right == 0 && down > 0)) && steps >= slowestSteps && side / steps >= shortestPeriodPx;
}

struct Peak {
    int down = 0, right = 0;
};

float at(const cv::Mat& powers, int down, int right)
{
    const int side = powers.rows;
    return powers.at<float>((down + side) % side, (right + side) % side);
}

std::optional<Peak> strongest(const cv::Mat& powers)
{
    const int side = powers.rows;
    std::optional<Peak> best;
    double most = 0;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const int down = stepsOf(row, side), right = stepsOf(column, side);
            const double weighed = powers.at<float>(row, column) * std::hypot(down, right);
            if (isSearched(down, right, side) && weighed > most) {
                most = weighed;
                best = Peak{down, right};
            }
        }
    return best;
}

/// Median power over all directions at nearly the period of the peak.
double medianAround(const cv::Mat& powers, const Peak& peak)
{
    const int side = powers.rows;
    const double radius = std::hypot(peak.down, peak.right);
    std::vector<float> ring;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            if (std::abs(std::hypot(stepsOf(row, side), stepsOf(column, side)) / radius - 1) < 0.1)
                ring.push_back(powers.at<float>(row, column));
    std::nth_element(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2), ring.end());
    return ring[ring.size() / 2];
}

}  // namespace

std::optional<DominantWave> dominantWave(const cv::Mat& picture, double leastProminence)
{
    const int side = windowSide(picture);
    if (side < smallestWindow) return std::nullopt;
    const cv::Mat powers = powersOf(greyOf(picture), side);
    const std::optional<Peak> peak = strongest(powers);
    if (!peak) return std::nullopt;
    const double prominence = at(powers, peak->down, peak->right) / std::max(1e-30, medianAround(powers, *peak));
    if (!(prominence >= leastProminence)) return std::nullopt;
    double mass = 0, down = 0, right = 0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const double power = at(powers, peak->down + y, peak->right + x);
            mass += power;
            down += power * (peak->down + y);
            right += power * (peak->right + x);
        }
    down /= mass;
    right /= mass;
    const double angle = std::atan2(down, right) * 180 / std::numbers::pi;
    return DominantWave{side / std::hypot(down, right), std::fmod(angle + 180, 180), prominence};
}

double waveShare(const cv::Mat& picture, const DominantWave& wave)
{
    const int side = windowSide(picture);
    if (side < smallestWindow) return 0;
    const cv::Mat powers = powersOf(greyOf(picture), side);
    const double radius = side / wave.periodPx, angle = wave.directionDeg * std::numbers::pi / 180;
    const double down = radius * std::sin(angle), right = radius * std::cos(angle);
    double near = 0, all = 0;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const int y = stepsOf(row, side), x = stepsOf(column, side);
            if (std::hypot(y, x) < slowestSteps) continue;
            const double power = powers.at<float>(row, column);
            all += power;
            if (std::min(std::hypot(y - down, x - right), std::hypot(y + down, x + right)) <= waveWidthSteps) near += power;
        }
    return all > 0 ? near / all : 0;
}

double angleBetween(const DominantWave& a, const DominantWave& b)
{
    const double apart = std::fmod(std::abs(a.directionDeg - b.directionDeg), 180);
    return std::min(apart, 180 - apart);
}

}  // namespace rendering::signals
