#include "rendering/models/seeing/told_lamp.h"

#include <cmath>
#include <opencv2/core.hpp>

namespace rendering::models {

namespace {

constexpr double middleDeg = 112.5, halfRangeDeg = 22.5;  ///< of the side of a lamp after turned(): top to upper left

double inCircle(double degrees) { return std::fmod(std::fmod(degrees, 360) + 360, 360); }

void mirror(cv::Mat& image, int turn)
{
    if ((turn & 3) != 0) cv::flip(image, image, (turn & 3) == 3 ? -1 : (turn & 3) == 1 ? 1 : 0);
}

}  // namespace

double sideAfter(double lightDeg, int turn)
{
    // The axes of the picture point right and down, so a swap mirrors at upper left.
    if ((turn & 4) != 0) lightDeg = 270 - lightDeg;
    if ((turn & 1) != 0) lightDeg = 180 - lightDeg;
    return inCircle((turn & 2) != 0 ? -lightDeg : lightDeg);
}

std::optional<double> ToldLamp::sideDeg() const
{
    if (numbers[0] == 0) return std::nullopt;
    return middleDeg + halfRangeDeg * double(numbers[1]);
}

ToldLamp toldLamp(const std::optional<double>& lightDeg)
{
    if (!lightDeg) return {};
    for (int turn = 0; turn < 8; ++turn)
        if (const double side = sideAfter(*lightDeg, turn); std::abs(side - middleDeg) <= halfRangeDeg)
            return {turn, {1, static_cast<float>((side - middleDeg) / halfRangeDeg)}};
    return {};
}

cv::Mat turned(const cv::Mat& image, int turn)
{
    cv::Mat result = (turn & 4) != 0 ? cv::Mat(image.t()) : image.clone();
    mirror(result, turn);
    return result;
}

cv::Mat turnedBack(const cv::Mat& image, int turn)
{
    cv::Mat result = image.clone();
    mirror(result, turn);
    return (turn & 4) != 0 ? cv::Mat(result.t()) : result;
}

}  // namespace rendering::models
