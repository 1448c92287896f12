// Patches of a laboratory's photographs with what was measured of them, in the layout of the networks. No torch here.
#pragma once

#include "rendering/models/lab/lab_cloth.h"
#include "rendering/models/seeing/cloth_batches.h"

namespace rendering::models {

/// Windows of presses at the pitch of a patch, which show the same fabric at other places.
struct PressWindows {
    int side = 0;  ///< px, a multiple of 16; 0: no press, or none is large enough
    int count = 0;
    std::vector<float> reliefs;     ///< [count, 1, side, side], pixels, without slow parts, 0 where nothing was measured
    double measured = 1;            ///< share of measured points
    double highestFrequency = 0.5;  ///< cycles a pixel that the presses resolve
};

struct LabBatch {
    ClothBatch cloth;                   ///< reliefs, logFrictions and logRatios are NaN where nothing was measured
    std::vector<char> amplitudesKnown;  ///< 0: the registered relief has an unknown scale
    std::vector<PressWindows> presses;  ///< for patches without registered relief
};

struct LabBatchOptions {
    int size = 4;
    int side = 128;
    double toldShare = 0.6;        ///< share of the pictures with one lamp whose side is told
    double logFrictionFactor = 0;  ///< logarithm of the lab's friction over the networks'; taken out
    double reliefFactor = 1;       ///< the lab's relief over the networks'; taken out
};

/// Batch `number` of a seed, from the training part, fabrics with equal shares. Equal arguments give an equal batch.
LabBatch drawLabBatch(const LabCloth& lab, const Architecture& architecture, const LabBatchOptions& options, std::uint64_t seed,
                      std::uint64_t number);

}  // namespace rendering::models
