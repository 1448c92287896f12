// From signals to what the display shows: composition m' = f_avg * h' (paper, eq. 4) and the range
// law (eq. 5) over all the objects shown, per condition. Taken image by image, scaling by the mean
// friction would cancel exactly and h&f would equal h.
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "protocols/condition.h"
#include "protocols/ids.h"
#include "rendering/composition/screen_extension.h"

namespace rendering {

inline constexpr int displayWidthPx = 1280;  ///< TanvasTouch, 10.1 inch
inline constexpr int displayHeightPx = 800;
inline constexpr double displayMmPerPixel = 0.170;

/// What a condition's two sources deliver for one fabric; the absent one is empty.
struct Sources {
    cv::Mat relief;  ///< CV_32FC1, any unit that grows with height; at least 1x1
    std::optional<double> reliefMmPerPixel;
    std::vector<double> trace;           ///< friction over the stroke
    double traceMmPerSample = 0;         ///< stroke speed / sample rate
    std::optional<double> meanFriction;  ///< f_avg, carried as its own value
};

/// m' of one fabric on the screen, before the range law.
struct ScaledMap {
    cv::Mat values;              ///< CV_32FC1 [800 x 1280]
    std::string extension = {};  ///< how a smaller source was continued: "tile", "mirror", "none (cropped)"
    /// Share of the source's variance about its mean, over its whole area, that does not reach the screen:
    /// what was cropped and, at the physical scale, what the display's pixels cannot hold. None for a
    /// constant source.
    std::optional<double> varianceLost = {};
    double agreement = 0;  ///< of the strips where patches overlap, correlation; 0 where none do
};

enum class Scale { Pixels, Physical };

/// The axis of the display along which traces are laid and the finger strokes.
inline constexpr char strokeAxis = 'x';

/// Relief alone, trace alone (constant across the stroke, which runs along x), or friction x relief,
/// by the row of the condition. `pixels` lays one source pixel on one display pixel as in the paper;
/// `physical` keeps millimetres with an anti-aliasing filter and needs the source's pitch (badInput else).
/// Throws workFailed for values that are not finite or beyond 1e30.
ScaledMap compose(const protocols::Condition& condition, const Sources& sources, Scale scale,
                  Extension extension = Extension::Tile);

/// min(m') and max(m') over all objects of a condition.
struct MapRange {
    double min = 0;
    double max = 0;
    void include(const ScaledMap& map);
    bool empty = true;
    bool constant() const { return !(max > min); }
};

/// The range without the lowest and highest pixels of all objects together, so that a speck of dust does
/// not flatten the rest: from percentile `low` to `high`, to 1/65536 of the whole range. The whole range
/// where nothing lies between.
class RobustRange {
public:
    explicit RobustRange(const MapRange& whole);
    void include(const ScaledMap& map);  ///< every map that the whole range is of, once
    MapRange between(double lowPercentile, double highPercentile) const;

private:
    MapRange m_whole;
    std::vector<std::uint64_t> m_counts;
};

/// Share of a map's pixels outside a range.
double shareOutside(const ScaledMap& map, const MapRange& range);

struct DisplayMapping {
    int bits = 8;         ///< 8 (0..255, what the display takes) or 16 (0..65535, to look at and to compare)
    bool dither = false;  ///< noise of one level before rounding, so that no steps are felt in a slow slope
    std::uint64_t seed = 1;
    bool operator==(const DisplayMapping&) const = default;
};

/// Eq. 5 to 0..255, rounded. A constant range maps to 0: no relief, the glass's own friction.
cv::Mat mapToDisplay(const ScaledMap& map, const MapRange& range, const DisplayMapping& mapping = {});

}  // namespace rendering
