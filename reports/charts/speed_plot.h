// Speed against accuracy as a drawing: points with intervals in both directions, and lines of conditional accuracy. It reads the
// same in grey: points differ by number or shape, lines by dashes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "protocols/files/svg_drawing.h"
#include "reports/charts/figure_width.h"
#include "stats/kernels/value.h"

namespace reports {

/// A point with its intervals; left out where a number does not exist.
struct SpeedPoint {
    std::string name;          ///< a condition or plain text, shown in the legend
    stats::Value time, share;  ///< median response time, s; share correct
    stats::Interval secondsCi, shareCi;
};

/// Share correct against response time, from fast to slow.
struct SpeedLine {
    std::string name;                ///< plain text, shown in the legend
    std::vector<SpeedPoint> points;  ///< their names are not shown
};

enum class PointSigns { Numbers, Shapes };

struct SpeedPlot {
    std::string title = {}, description = {};  ///< for readers who cannot see the drawing
    std::vector<SpeedPoint> points = {};
    std::vector<SpeedLine> lines = {};
    std::vector<double> deadlines = {};  ///< s, drawn as vertical lines
    int alternatives = 2;                ///< chance is 1/alternatives; 0: there is no line of chance
    PointSigns signs = PointSigns::Numbers;
};

/// One <svg> element.
std::string drawn(const SpeedPlot& plot, FigureWidth width);

}  // namespace reports
