// A data set of invented fabrics: 15 structures, each with a weave or knit draft, yarn spacing and diameter,
// crimp, twist and hairiness. Each sample is a height field that is photographed, pressed into a simulated
// GelSight sensor, or stroked by a simulated friction rig.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

struct ProceduralOptions {
    int fabrics = 15;   ///< 1 to 15
    int samples = 225;  ///< number for each signal of each fabric
    std::uint64_t seed = 1;
    Pairing pairing = Pairing::Weak;  ///< weak: photograph, press and stroke lie at different places
    unsigned threads = 0;             ///< 0: one for each processor; does not change the result
};

/// Writes the data set into a temporary folder beside `folder`, then renames it. Throws badInput where `folder` exists and
/// is not empty, environmentFault where it cannot be written. Calls `progress(done, total)` from one thread at a time.
Dataset makeProceduralFabrics(const std::filesystem::path& folder, const ProceduralOptions& options,
                              const std::function<void(int, int)>& progress = {});

}  // namespace rendering::fabrics
