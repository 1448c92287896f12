// Guessers who see every tray of a choice phase, know how designs are drawn, and name the true slot.
// They are as strong as we could make them: the test that they stay at chance is worth no more than they.
#pragma once

#include <vector>

#include "protocols/counterbalancing.h"
#include "protocols/random.h"

namespace tray_guessers {

/// All that an operator can join over a study: fabrics by [participant][presentation][slot].
using SeenTrays = std::vector<std::vector<std::vector<int>>>;

/// [participant][presentation][slot]: the higher, the likelier the true one. Of equals none is preferred.
using Belief = std::vector<std::vector<std::vector<double>>>;

/// The first phase of a design, which must be a choice, without what is true in it.
SeenTrays seenOf(const protocols::Design& design);

/// Expected number of true slots that are named by taking the likeliest, ties shared.
double hitsOf(const Belief& belief, const protocols::Design& design);

/// Knows that a fabric is never true twice running, how often each is true per participant and slot,
/// each foil set per true fabric and each ordered pair over the study: exact marginals of a chain
/// (forward-backward), its weights fitted until the expected counts are those (iterative scaling).
Belief beliefOfChain(const SeenTrays& trays);

/// Knows all that the design balances: draws whole assignments that fulfil it as well as the true one
/// does (Metropolis), and counts how often each slot is true in them.
Belief beliefOfSampler(const SeenTrays& trays, std::int64_t moves, protocols::Random& random);

}  // namespace tray_guessers
