// Adaptation of a trained model to a laboratory's own cloth: to its camera, its presses and its strokes. No torch here.
//
// A laboratory's rig has a scale of its own: another probe or load changes all friction by about one factor, and a press shows
// flatter cloth than a free surface. These factors are found first and kept in the model card, outside the networks. The
// networks learn what is left, half from the lab's cloth and half from drawn cloth. So what they know of other cloth stays.
#pragma once

#include "rendering/models/seeing/cloth_training.h"

namespace rendering::models {

/// The shipped abilities may become worse by this, percent.
inline constexpr double mostWorsePercent = 5;
/// A gain below this share is none.
inline constexpr double leastGain = 0.02;

/// Adapts `options.from` to `lab` and writes it to `options.out` with its card. Prints what was gained on held-out places and
/// fabrics, and what the shipped abilities paid. `scans`: joins the drawn cloth without scansOfHeldOut(), or nullptr. Throws
/// badInput for data that do not suffice (lab_cloth.h), workFailed where nothing was gained (no model is written) or the loss
/// stops being finite, and as trainOnCloth().
void adaptToLab(const fabrics::Dataset& lab, const fabrics::Dataset* scans, const ClothTrainingOptions& options,
                std::ostream& log, bool terminal);

}  // namespace rendering::models
