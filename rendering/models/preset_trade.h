// What each setting of preset.h cost and gave up in one table of `vis2hap bench`, measured while other work ran.
// `render.json` records it with every image.
#pragma once

#include <array>

namespace rendering::models {

/// One stage. Time and error in the order fast, balanced, accurate.
struct PresetTrade {
    const char* stage;
    std::array<double, 3> milliseconds;
    std::array<double, 3> error;
    const char* errorIs;
};

inline constexpr const char* presetTradeMachine = "2 cores, Debian GNU/Linux 12, beside other work";

inline constexpr std::array<PresetTrade, 4> presetTrades{{
    {"integration 480x640", {4.85, 18.2, 18.2}, {0.000396, 0.000382, 0.000382}, "% of Sq"},
    {"shape from shading 512x512", {29.7, 41.1, 41.1}, {0.290, 0.282, 0.282}, "1 - |r|"},
    {"spectrogram inversion", {0.328, 1.25, 8.60}, {23.3, 8.84, 6.48}, "% of magnitude"},
    {"photograph to relief", {26.1, 53.6, 196}, {76.7, 78.5, 78.5}, "% of Sq"},
}};

}  // namespace rendering::models
