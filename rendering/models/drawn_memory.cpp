#include "rendering/models/drawn_memory.h"

#include "rendering/fabrics/drawn/drawn_dataset.h"

namespace rendering::models {

std::string noteOnDrawnFabrics(const fabrics::Dataset& dataset, const ModelCard& model)
{
    const auto seed = fabrics::drawnSeedOf(dataset);
    if (!seed || !model.drawnSeeds.contains(*seed)) return {};
    return model.name + " was trained on fabrics that seed " + std::to_string(*seed) +
           " draws, and this data set has the same: the figures also measure memory. Make a data set by another --seed";
}

}  // namespace rendering::models
