// From a map m' to the levels of the display: the range law (paper, eq. 5). The range is taken over all fabrics of a
// condition. Taken image by image, scaling by the mean friction would cancel exactly, and h&f would equal h.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rendering/composition/friction_image.h"
#include "rendering/response/display_response.h"

namespace rendering {

/// min(m') and max(m') over all fabrics of a condition.
struct MapRange {
    double min = 0;
    double max = 0;
    void include(const ScaledMap& map);
    void include(double low, double high);
    bool empty = true;
    bool constant() const { return !(max > min); }
};

/// Range between percentiles of the pixels of all fabrics together, so that a speck of dust does not flatten the rest.
/// The resolution is 1/65536 of the whole range. The whole range is used where nothing lies between the percentiles.
class RobustRange {
public:
    explicit RobustRange(const MapRange& whole);
    void include(const ScaledMap& map);  ///< call once for every map of the whole range
    MapRange between(double lowPercentile, double highPercentile) const;

private:
    MapRange m_whole;
    std::vector<std::uint64_t> m_counts;
};

/// Share of a map's pixels that lie outside a range.
double shareOutside(const ScaledMap& map, const MapRange& range);

struct DisplayMapping {
    int bits = 8;         ///< 8 (0 to 255, for the display) or 16 (0 to 65535, for viewing and comparison)
    bool dither = false;  ///< adds noise of one level before rounding, so that slow slopes have no perceptible steps
    std::uint64_t seed = 1;
    /// Friction of the display by level: a map then becomes levels whose friction is linear in m'. Null: levels are linear in m'.
    std::shared_ptr<const DisplayResponse> response = nullptr;
    bool operator==(const DisplayMapping&) const = default;
};

/// The friction of an image on the display: CV_16UC1, from 0 for the lowest measured friction to 65535 for the highest.
cv::Mat frictionOnDisplay(const cv::Mat& image, const DisplayResponse& response);

/// Share of a map's pixels whose friction no level of the response gives within `reachTolerance`.
double shareOutOfReach(const ScaledMap& map, const MapRange& range, const DisplayResponse& response);

/// Eq. 5: levels 0 to 255, rounded. A constant range maps to 0, which leaves only the glass's own friction. A response takes 8
/// bits only, because it was measured at these levels.
cv::Mat mapToDisplay(const ScaledMap& map, const MapRange& range, const DisplayMapping& mapping = {});

}  // namespace rendering
