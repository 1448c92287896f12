// Images that cannot show what a study wants to compare: two conditions that a finger cannot tell apart, and fabrics that use
// little of the display.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "rendering/composition/render_fabrics.h"

namespace rendering {

/// Two images count as the same below 3 grey levels of 255 (RMS, pixel by pixel), a hundredth of the display's voltage. They also
/// do where their means differ by less than that and their spectra by less than 1 dB: a finger does not know where it is, and
/// the smallest difference of amplitude that it feels on electrovibration is 1.16 dB (Bau et al., "TeslaTouch", 2010).
inline constexpr double fewestGreyLevels = 3, fewestDecibels = 1;
inline constexpr double leastRangeUsed = 0.1;  ///< share of the display's range between the 0.1st and the 99.9th percentile

struct ImageDistance {
    double greyLevels = 0;  ///< RMS difference, of 255
    double meanLevels = 0;  ///< difference of the means, of 255
    double decibels = 0;    ///< RMS difference of the powers in 16 rings of frequency, over a middle of at most 512 x 512 pixels
    bool same() const { return greyLevels < fewestGreyLevels || (meanLevels < fewestGreyLevels && decibels < fewestDecibels); }
};

/// Both CV_8UC1 or CV_16UC1, of one size.
ImageDistance distanceOf(const cv::Mat& a, const cv::Mat& b);

struct SameImages {
    protocols::FabricId fabric;
    protocols::ConditionId first, second;
    ImageDistance distance;
};

struct FlatImage {
    protocols::FabricId fabric;
    protocols::ConditionId condition;
    double rangeUsed = 0;  ///< 0 to 1
};

struct ImageFaults {
    std::vector<SameImages> same;
    std::vector<FlatImage> flat;
};

ImageFaults imageFaults(const RenderedFabrics& rendering);

/// One line for each condition whose images come from friction records of several quantities, such as a coefficient and the
/// counts of a sensor: each has a range of its own, so that the finger cannot compare these fabrics.
std::vector<std::string> mixedQuantities(const RenderedFabrics& rendering);

/// One line for each condition with pixels whose friction the display's response does not reach, with their share by fabric.
std::vector<std::string> frictionOutOfReach(const RenderedFabrics& rendering);

/// One line for each pair of conditions with fabrics that it shows alike, and one for each condition with flat images, which also
/// names the fabrics that set its range.
std::vector<std::string> describe(const ImageFaults& faults, const RenderedFabrics& rendering);

/// {"same": [{"fabric", "conditions", "grey_levels", "mean_levels", "decibels"}], "flat": [{"fabric", "condition",
/// "range_used"}]}
nlohmann::ordered_json jsonOf(const ImageFaults& faults);

}  // namespace rendering
