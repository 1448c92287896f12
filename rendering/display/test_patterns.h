// Images that test a display by touch, before a participant comes.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rendering {

enum class TestPatternKind { Uniform, Edge, Grating, Ramp };

struct TestPattern {
    TestPatternKind kind = TestPatternKind::Uniform;
    double periodMm = 0;  ///< period of a grating, mm; 0 for the others
    bool operator==(const TestPattern&) const = default;
};

/// The patterns that the app offers: uniform, edge, gratings of 1, 2, 4 and 8 mm, and a ramp from left to right.
const std::vector<TestPattern>& testPatterns();

/// "uniform", "edge", "grating 2 mm", "left–right ramp".
std::string nameOf(const TestPattern& pattern);

/// Whether the pattern has a length in mm, so that it needs the scale of the display.
bool needsScale(const TestPattern& pattern);

/// The pattern as an image of the display, CV_8UC1. 0 is the lowest friction, 255 the highest. Uniform: 255 everywhere. Edge: the
/// left half 0, the right half 255. Grating: vertical stripes, 0 in the first half of each period and 255 in the second. Ramp: 0
/// in the first column to 255 in the last. `sizePx`: none takes the size of a friction image. `mmPerPixel` is used by gratings
/// only. Throws badInput where a grating has no scale, or a period that is shorter than two pixels.
cv::Mat testPatternImage(const TestPattern& pattern, std::optional<cv::Size> sizePx, std::optional<double> mmPerPixel);

}  // namespace rendering
