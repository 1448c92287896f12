// Comparison of a generated with a measured height map: three variants of structural similarity, spectrum and roughness.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "study/evaluation/measures.h"

namespace study::evaluation {

/// Reason why a constant map has no roughness ratio.
inline constexpr const char* flatMapWhy = "a flat map has no texture";

/// Height map with its pitch and the rotation of the fabric.
struct HeightMap {
    cv::Mat heightMm;        ///< CV_32FC1
    double pitchMm = 1;      ///< mm per pixel
    double rotationDeg = 0;  ///< rotation of the fabric in the map, anticlockwise; 0 if unknown
    bool isFlat() const;
};

/// The map resampled to another pitch; unchanged if the pitches agree within 1e-6.
HeightMap atPitch(HeightMap map, double pitchMm);

/// Features of a height map that do not depend on place and direction, from its middle square.
struct HeightFeatures {
    std::vector<double> bandPowers;  ///< mean power in third-octave bands from 6.4 to 0.2 mm wavelength, mm⁴; no empty bands
    double sqMm = 0;                 ///< RMS height
    double sdr = 0;                  ///< developed area ratio
    double salMm = 0;                ///< autocorrelation length
};

/// Features of the middle square with `side` pixels, at most the shorter side of the map.
HeightFeatures heightFeatures(const HeightMap& map, int side);

/// Spectral distance, dB: root mean square over the bands of 10 log10 of the ratio of powers. A floor 40 dB below the strongest
/// measured band is added to each power, so that a flat map has a distance, too. Undefined if the measured map is flat or if a
/// map is too small.
stats::Value bandDistance(const HeightFeatures& generated, const HeightFeatures& measured);

/// The middle square of `side` pixels, rotated (cubic interpolation) so that the axes of the fabric lie along rows and columns.
cv::Mat alongFabric(const HeightMap& map, int side);
/// Side of the largest such square that lies completely inside the map, px.
int largestSideAlongFabric(const HeightMap& map);

/// Sets all height measures except identification. `rangeMm`: L of the structural similarity. Both maps have the same pitch.
void compareHeights(const HeightMap& generated, const HeightFeatures& generatedFeatures, const HeightMap& measured,
                    const HeightFeatures& measuredFeatures, double rangeMm, Values& values);

/// Side of the middle square of the generated map that registration searches for in the measured map, px. For presses of
/// 12 × 16 mm the search covers 3.4 mm, one repeat of the coarsest fabrics.
inline constexpr int registeredSidePx = 128;

}  // namespace study::evaluation
