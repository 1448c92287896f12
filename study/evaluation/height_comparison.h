// A generated against a measured height map: structural similarity in three ways, spectrum, roughness.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "study/evaluation/measures.h"

namespace study::evaluation {

/// Why a constant map has no ratio of roughness.
inline constexpr const char* flatMapWhy = "a flat map has no texture";

/// A map at the pitch of the measured ones.
struct HeightMap {
    cv::Mat heightMm;        ///< CV_32FC1
    double pitchMm = 1;      ///< mm a pixel
    double rotationDeg = 0;  ///< of the fabric in it, anticlockwise; 0 where unknown
    bool isFlat() const;
};

/// `map` brought to another pitch; the map itself where they are equal within 1e-6.
HeightMap atPitch(HeightMap map, double pitchMm);

/// What tells heights apart whatever their place and direction; of a middle square.
struct HeightFeatures {
    std::vector<double>
        bandPowers;  ///< mean power in thirds of an octave from 6.4 to 0.2 mm wavelength, mm^4; the empty ones left out
    double sqMm = 0;
    double sdr = 0;
    double salMm = 0;
};

/// The middle square of `side` pixels, at most the map's shorter side.
HeightFeatures heightFeatures(const HeightMap& map, int side);

/// Root mean square over the bands of 10 log10 of the ratio of powers, each at least -40 dB of the measured map's strongest
/// band: a flat map has a distance, too. Undefined with its reason where the measured map is flat or a map is too small.
stats::Value bandDistance(const HeightFeatures& generated, const HeightFeatures& measured);

/// The fabric's own axes along rows and columns: turned by its rotation (cubic), middle square of `side` pixels.
cv::Mat alongFabric(const HeightMap& map, int side);
/// The largest such square that lies wholly inside the map.
int largestSideAlongFabric(const HeightMap& map);

/// All height measures but identification. `rangeMm`: L of the structural similarity. Both maps at one pitch.
void compareHeights(const HeightMap& generated, const HeightFeatures& generatedFeatures, const HeightMap& measured,
                    const HeightFeatures& measuredFeatures, double rangeMm, Values& values);

/// The registered similarity looks for the middle of the generated map, so many px wide, all over the measured one: 3.4 mm
/// of search for presses of 12 x 16 mm, a repeat of the coarsest fabrics.
inline constexpr int registeredSidePx = 128;

}  // namespace study::evaluation
