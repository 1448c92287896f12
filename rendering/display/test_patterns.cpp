#include "rendering/display/test_patterns.h"

#include <cmath>

#include "protocols/files/errors.h"
#include "rendering/composition/friction_image.h"

namespace rendering {

namespace {

constexpr double highestFriction = 255;

double patternValue(const TestPattern& pattern, int column, int columns, double mmPerPixel)
{
    switch (pattern.kind) {
        case TestPatternKind::Uniform:
            return highestFriction;
        case TestPatternKind::Edge:
            return 2 * column < columns ? 0 : highestFriction;
        case TestPatternKind::Grating: {
            const double periods = (column + 0.5) * mmPerPixel / pattern.periodMm;
            return periods - std::floor(periods) < 0.5 ? 0 : highestFriction;
        }
        case TestPatternKind::Ramp:
            return columns > 1 ? std::round(highestFriction * column / (columns - 1)) : highestFriction;
    }
    return 0;
}

double requiredScale(const TestPattern& pattern, std::optional<double> mmPerPixel)
{
    if (!mmPerPixel || !(*mmPerPixel > 0))
        throw protocols::badInput({.what = "the scale of the display is unknown",
                                   .where = nameOf(pattern),
                                   .expected = "the width of one pixel in mm",
                                   .nextStep = "measure the width of the active area, and divide it by the number of pixels"});
    if (pattern.periodMm < 2 * *mmPerPixel)
        throw protocols::badInput({.what = "the pixels of the display are too large for this pattern",
                                   .where = nameOf(pattern),
                                   .expected = "at least 2 pixels in each period",
                                   .nextStep = "choose a longer period, or correct the mm per pixel"});
    return *mmPerPixel;
}

}  // namespace

const std::vector<TestPattern>& testPatterns()
{
    using enum TestPatternKind;
    static const std::vector<TestPattern> all{{Uniform, 0}, {Edge, 0},    {Grating, 1}, {Grating, 2},
                                              {Grating, 4}, {Grating, 8}, {Ramp, 0}};
    return all;
}

std::string nameOf(const TestPattern& pattern)
{
    switch (pattern.kind) {
        case TestPatternKind::Uniform:
            return "uniform";
        case TestPatternKind::Edge:
            return "edge";
        case TestPatternKind::Grating:
            return "grating " + std::to_string(std::lround(pattern.periodMm)) + " mm";
        case TestPatternKind::Ramp:
            return "left–right ramp";
    }
    return {};
}

bool needsScale(const TestPattern& pattern) { return pattern.kind == TestPatternKind::Grating; }

cv::Mat testPatternImage(const TestPattern& pattern, std::optional<cv::Size> sizePx, std::optional<double> mmPerPixel)
{
    const double scale = needsScale(pattern) ? requiredScale(pattern, mmPerPixel) : 1;
    const cv::Size size = sizePx.value_or(cv::Size(displayWidthPx, displayHeightPx));
    cv::Mat image(size, CV_8UC1);
    for (int column = 0; column < size.width; ++column) image.col(column).setTo(patternValue(pattern, column, size.width, scale));
    return image;
}

}  // namespace rendering
