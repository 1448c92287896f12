// The losses of the paper for the networks that see any cloth: controls for our own losses, trained on the same drawn fabrics.
// No torch in this header.
#pragma once

#include "rendering/models/networks/training.h"
#include "rendering/models/seeing/cloth_training.h"

namespace rendering::models {

/// For ClothTrainingOptions::makeObjective: equations (1) to (3) of the paper for Objective::Reference, (3) alone for
/// Objective::L1Only, nothing for Objective::Default. Heights are in pixels, each map without its mean. The paper has no
/// interval of friction, so its deviation is not learnt.
decltype(ClothTrainingOptions::makeObjective) paperObjective(Objective objective);

}  // namespace rendering::models
