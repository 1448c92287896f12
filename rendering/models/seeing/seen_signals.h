// Signals of a photograph by the networks that see. Only the torch sources include it.
#pragma once

#include "rendering/models/generation.h"
#include "rendering/models/seeing/seeing_weights.h"

namespace rendering::models {

/// Relief and friction of a photograph at its own pitch; a photograph of unknown pitch must have been given one. Relief is at
/// or above 0 but for Architecture::zeroPercentile percent of it. Throws badInput where the weights give no finite numbers.
GeneratedSignals seenSignals(SeeingNetworks& networks, const Architecture& architecture, const InputPhotograph& photograph,
                             const GenerationOptions& options);

}  // namespace rendering::models
