// From signals to a map on the screen: the composition m' = f_avg * h' (paper, eq. 4). display_mapping.h maps m' to
// the levels of the display.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "protocols/condition.h"
#include "rendering/composition/screen_extension.h"

namespace rendering {

inline constexpr int displayWidthPx = 1280;  ///< TanvasTouch, 10.1 inch
inline constexpr int displayHeightPx = 800;
inline constexpr double displayMmPerPixel = 0.170;

/// Sources of a condition for one fabric; an unused source is empty.
struct Sources {
    cv::Mat relief;  ///< CV_32FC1 in any unit that increases with height; at least 1x1
    std::optional<double> reliefMmPerPixel;
    std::optional<double> reliefLeftOut;  ///< set where `relief` is the shown part of a larger one: share of variance outside it
    std::vector<double> trace;            ///< friction over the stroke
    double traceMmPerSample = 0;          ///< stroke speed divided by sample rate
    std::optional<double> meanFriction;   ///< f_avg
};

/// m' of one fabric on the screen.
struct ScaledMap {
    cv::Mat values;              ///< CV_32FC1 [800 x 1280]
    std::string extension = {};  ///< method that extends a smaller source: "tile", "mirror", "none (cropped)"
    /// Share of the source's variance that does not reach the screen, over the whole source. Lost is what was cropped and, at
    /// the physical scale, what the display's pixels cannot resolve. nullopt for a constant source.
    std::optional<double> varianceLost = {};
    double agreement = 0;  ///< correlation of overlapping strips; 0 where there are none
};

enum class DisplayScale { Pixels, Physical };

/// Axis of the display along which traces run and the finger strokes.
inline constexpr char strokeAxis = 'x';

/// Composes relief alone, trace alone (constant across the stroke, which runs along x) or friction x relief, as the
/// condition states. `Pixels` puts one source pixel on one display pixel, as in the paper. `Physical` keeps millimetres with
/// an anti-aliasing filter and needs the source's pitch (badInput without it). Throws badInput for a negative mean friction, and
/// workFailed for values that are not finite or exceed 1e30.
ScaledMap compose(const protocols::Condition& condition, const Sources& sources, DisplayScale scale,
                  Extension extension = Extension::Tile);

}  // namespace rendering
