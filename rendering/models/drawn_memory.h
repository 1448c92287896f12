// Memory of drawn fabrics: a training and a data set of drawn fabrics that have the same seed have the same constructions.
#pragma once

#include <string>

#include "rendering/fabrics/dataset.h"
#include "rendering/models/model_card.h"

namespace rendering::models {

/// A note where the training of the model drew the fabrics of this data set; empty where no such thing is known.
std::string noteOnDrawnFabrics(const fabrics::Dataset& dataset, const ModelCard& model);

}  // namespace rendering::models
