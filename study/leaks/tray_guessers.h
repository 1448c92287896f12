// Guessers who see every tray of a choice phase, know how designs are drawn, and guess the true slot. They are as strong as we
// could make them. The test that they stay at chance is only as strong as they are.
#pragma once

#include <vector>

#include "protocols/orders/counterbalancing.h"
#include "protocols/random.h"

namespace study::leaks {

/// Everything that an operator can collect over a study: fabrics by [participant][presentation][slot].
using SeenTrays = std::vector<std::vector<std::vector<int>>>;

/// [participant][presentation][slot]: a higher value is more likely the true slot. Ties are shared.
using Belief = std::vector<std::vector<std::vector<double>>>;

/// The first phase of a design, which must be a choice, without the true fabrics.
SeenTrays seenOf(const protocols::Design& design);

/// Expected number of true slots found by taking the likeliest, ties shared.
double hitsOf(const Belief& belief, const protocols::Design& design);

/// Knows that a fabric is never true twice in a row (of more than two). Knows the counts of true fabrics per participant, of foil
/// sets per true fabric and of ordered pairs over the study. Exact marginals of a chain (forward-backward); iterative scaling
/// fits its weights until the expected counts are these.
Belief beliefOfChain(const SeenTrays& trays);

/// Knows that each fabric is true equally often to a participant, and never twice in a row (of more than two): exact marginals
/// over all orders that fit the trays. For lists where these are too many, or whose length is no multiple of the fabrics, every
/// slot is equally likely.
Belief beliefOfCounts(const SeenTrays& trays);

/// Knows everything that the design balances: draws whole assignments that are as well balanced as the true one (Metropolis) and
/// counts how often each slot is true in them.
Belief beliefOfSampler(const SeenTrays& trays, std::int64_t moves, protocols::Random& random);

}  // namespace study::leaks
