// A data set of drawn fabrics: photographs through a drawn camera with the surface that they show, presses of a simulated sensor
// and strokes of a simulated rig. Every photograph has its own scale and light.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

inline constexpr int drawnPhotographPx = 256;

struct DrawnOptions {
    int fabrics = 40;  ///< 1 to 10,000
    int samples = 3;   ///< number for each signal of each fabric, 1 to 100,000
    std::uint64_t seed = 1;
    Pairing pairing = Pairing::Weak;  ///< weak: photograph, press and stroke lie at different places
    unsigned threads = 0;             ///< 0: one for each processor; does not change the result
};

/// Writes the data set into a temporary folder beside `folder`, then renames it. Fabric F01 is drawFabric(seed, 0). Throws
/// badInput for numbers out of range and where `folder` exists and is not empty, environmentFault where it cannot be written.
/// Calls `progress(done, total)` from one thread at a time.
Dataset makeDrawnFabrics(const std::filesystem::path& folder, const DrawnOptions& options,
                         const std::function<void(int, int)>& progress = {});

/// The seed of a data set that makeDrawnFabrics() wrote, from its name, which imports keep; nullopt for any other.
std::optional<std::uint64_t> drawnSeedOf(const Dataset& dataset);

}  // namespace rendering::fabrics
