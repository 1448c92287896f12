// A data set of fabrics that never existed: 15 structures from a weave or knit draft, yarn spacing and
// diameter, crimp, twist and hairiness; per sample one height field, photographed, pressed into a
// simulated GelSight and stroked by a simulated friction rig.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

struct ProceduralOptions {
    int fabrics = 15;   ///< 1..15
    int samples = 225;  ///< of each signal and fabric
    std::uint64_t seed = 1;
    Pairing pairing = Pairing::Weak;  ///< weak: photo, press and stroke at different places
    unsigned threads = 0;             ///< 0: as many as the machine has; changes no bit of the result
};

/// Writes the data set into a temporary folder beside `folder`, then renames it. Throws badInput where
/// `folder` exists and is not empty, environmentFault where it cannot be written.
/// `progress(done, total)` is called from one thread at a time.
Dataset makeProceduralFabrics(const std::filesystem::path& folder, const ProceduralOptions& options,
                              const std::function<void(int, int)>& progress = {});

}  // namespace rendering::fabrics
