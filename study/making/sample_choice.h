// Which sample of each fabric and signal a study shows: drawn by seed among those that the generators
// were not trained on.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "rendering/composition/render_fabrics.h"
#include "rendering/models/generation.h"

namespace study::making {

struct ChosenSamples {
    std::map<protocols::FabricId, rendering::SampleChoice> samples;
    bool someTrainedOn = false;
};

/// `trained`: sorted hashes of the model's training files; empty where no model is used. Throws
/// badInput naming the fabric and signal that has no other sample, unless `allowTrained`.
ChosenSamples chooseSamples(const rendering::fabrics::Dataset& dataset, const std::vector<protocols::FabricId>& fabrics,
                            const std::vector<rendering::Signal>& signals, const rendering::models::ModelCard* card,
                            std::uint64_t seed, bool allowTrained);

}  // namespace study::making
