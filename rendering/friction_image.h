// From signals to what the display shows: composition m' = f_avg * h' (paper, eq. 4) and the range
// law (eq. 5) over all the objects shown, per condition. Taken image by image, scaling by the mean
// friction would cancel exactly and h&f would equal h.
#pragma once

#include "protocols/condition.h"
#include "protocols/ids.h"

#include <opencv2/core/mat.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rendering {

inline constexpr int displayWidthPx = 1280;   ///< TanvasTouch, 10.1 inch
inline constexpr int displayHeightPx = 800;
inline constexpr double displayMmPerPixel = 0.170;

/// What a condition's two sources deliver for one fabric; the absent one is empty.
struct Sources {
    cv::Mat relief;                      ///< CV_32FC1, any unit that grows with height; at least 1x1
    std::optional<double> reliefMmPerPixel;
    std::vector<double> trace;           ///< friction over the stroke
    double traceMmPerSample = 0;         ///< stroke speed / sample rate
    std::optional<double> meanFriction;  ///< f_avg, carried as its own value
};

/// m' of one fabric on the screen, before the range law.
struct ScaledMap {
    cv::Mat values;          ///< CV_32FC1 [800 x 1280]
    std::string extension;   ///< how a smaller source was extended: "mirror", "none (cropped)"
};

enum class Scale { Pixels, Physical };

/// Relief alone, trace alone (constant across the stroke, which runs along x), or friction x relief,
/// by the row of the condition. `pixels` lays one source pixel on one display pixel as in the paper;
/// `physical` keeps millimetres with an anti-aliasing filter and needs the source's pitch (badInput else).
ScaledMap compose(const protocols::Condition& condition, const Sources& sources, Scale scale);

/// min(m') and max(m') over all objects of a condition.
struct MapRange {
    double min = 0;
    double max = 0;
    void include(const ScaledMap& map);
    bool empty = true;
    bool constant() const { return !(max > min); }
};

/// Eq. 5 to 0..255, rounded. A constant range maps to 0: no relief, the glass's own friction.
cv::Mat mapToDisplay(const ScaledMap& map, const MapRange& range);

}  // namespace rendering
