// Draws by seed the sample of each fabric and signal that a study shows, among those that the generators were not trained on.
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

/// `card`: the model, whose card lists the hashes of its training files; null where no model is used. Throws badInput for a
/// fabric without a sample, or, unless `allowTrained`, for one whose samples were all used in training.
ChosenSamples chooseSamples(const rendering::fabrics::Dataset& dataset, const std::vector<protocols::FabricId>& fabrics,
                            const std::vector<rendering::Signal>& signals, const rendering::models::ModelCard* card,
                            std::uint64_t seed, bool allowTrained);

}  // namespace study::making
