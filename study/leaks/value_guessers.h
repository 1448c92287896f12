// Guessers who read the values beside the trials.
#pragma once

#include <vector>

#include "study/leaks/guessers.h"

namespace study::leaks {

/// Guesses at the true pieces and the conditions by each value:
/// - equal values of a choice trial and a rating trial (whole, beginnings, ends, lengths), the nearest by order, the nearest by
///   differing letters, and all letters together; the rating trial's tray names the fabric;
/// - a value that names a piece of the tray, or whose number modulo the slots is the slot;
/// - learned from the truth about the other half of the slots: value -> slot, fabric, condition, and the nearest value's.
/// The last is more than an operator has. It finds any dependence without knowing its form.
std::vector<Guess> guessesByValues(const SeenStudy& study, const std::vector<Feature>& features, const Truth& truth);

}  // namespace study::leaks
