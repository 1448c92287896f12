// What the qualities `fast`, `balanced` and `accurate` mean: one row each, with every setting that it fixes. The settings are
// part of the program, so an image does not depend on the machine that made it.
//
// The rule, stage by stage, on the table of `vis2hap bench`:
//   accurate  the cheapest setting whose error is at most `accurateMost` times the least one;
//   fast      the cheapest setting whose error is at most `fastMost` times the least one;
//   balanced  what lowers the error most for at most `balancedPrice` times the time of `fast`.
// Such settings lie on the stage's Pareto front. `vis2hap bench --choose` prints what the rule would choose on another machine,
// and changes nothing.
//
// Integration, shading and phase have the settings of the rule. The networks do not: their averaging does not lower the error
// against known relief (77 to 79 % of Sq), so the rule would take `fast` three times. It makes results steadier from picture to
// picture, and images of earlier studies can be made again.
#pragma once

#include <array>

#include "rendering/models/generation.h"
#include "rendering/signals/shape_from_shading.h"
#include "rendering/signals/surface_integration.h"

namespace rendering::models {

struct Preset {
    Quality quality;
    const char* name;
    signals::IntegrationQuality integration;  ///< of the slopes of a tactile frame
    signals::ShadingQuality shading;          ///< of the linear method
    int phaseIterations;                      ///< Griffin-Lim iterations of a generated trace
    int pictures;                             ///< displaced pictures over which G_h averages
    int marginPx;     ///< pixels around G_h's picture that are cut off; at least 16 around each of several tiles
    int cropsAcross;  ///< G_s averages over the square of this number of crops
    // The networks of the paper, which a laboratory may train anew.
    int turns;           ///< symmetries of the square over which G_h averages
    int cropTurns;       ///< quarter turns of each crop of G_s
    int paperMarginPx;   ///< margin of a tile
    int spectrumPasses;  ///< passes of the filter that imposes the spectrum
};

inline constexpr double accurateMost = 1.01;
inline constexpr double balancedPrice = 5;
inline constexpr double fastMost = 4;

inline constexpr std::array<Preset, 3> presets{{
    {Quality::Fast, "fast", signals::IntegrationQuality::Fast, signals::ShadingQuality::Fast, 8, 1, 0, 1, 1, 1, 16, 1},
    {Quality::Balanced, "balanced", signals::IntegrationQuality::Full, signals::ShadingQuality::Accurate, 32, 1, 64, 2, 2, 1, 32,
     3},
    {Quality::Accurate, "accurate", signals::IntegrationQuality::Full, signals::ShadingQuality::Accurate, 200, 4, 64, 3, 8, 4, 32,
     6},
}};

/// The row of a quality.
constexpr const Preset& presetOf(Quality quality) { return presets[static_cast<std::size_t>(quality)]; }

}  // namespace rendering::models
