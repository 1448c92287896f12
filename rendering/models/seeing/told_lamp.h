// A lamp whose side is told. Relief and light change signs together: a photograph alone cannot tell a hill under a lamp from a
// hollow under the opposite one. A photograph with a known lamp is turned until the lamp stands between top and upper left.
// So the networks see one side only.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace rendering::models {

inline constexpr int lampNumbers = 2;

struct ToldLamp {
    int turn = 0;                              ///< symmetry of the square for turned()
    std::array<float, lampNumbers> numbers{};  ///< told (0 or 1); side from top (-1) to upper left (1)
    /// Side of the lamp in the turned picture, 90 to 135 degrees; nullopt where nobody told it.
    std::optional<double> sideDeg() const;
};

/// `lightDeg`: side from which the light comes, finite, 0 right, 90 top, anticlockwise; nullopt where nobody knows.
ToldLamp toldLamp(const std::optional<double>& lightDeg);

/// Side of a lamp after turned(), 0 to 360 degrees.
double sideAfter(double lightDeg, int turn);

/// One of the eight symmetries of the square: bit 2 swaps both axes, then bit 0 mirrors columns and bit 1 rows.
cv::Mat turned(const cv::Mat& image, int turn);
cv::Mat turnedBack(const cv::Mat& image, int turn);

}  // namespace rendering::models
