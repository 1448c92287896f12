// Draws the one fabric on the tray of a same/different phase, and the places of catch trials (blank glass).
#pragma once

#include <vector>

#include "protocols/counterbalancing.h"
#include "protocols/running_orders.h"
#include "protocols/trays.h"

namespace protocols {

/// The fabric on the tray, [participant][position]. It is the rendering's own in half of the presentations: per label x fabric
/// over participants, per participant x label, and per participant x fabric; odd counts differ by at most one. Otherwise it is
/// another fabric, each equally often.
std::vector<std::vector<Tray>> drawSameDifferentTrays(const std::vector<std::vector<Rendering>>& orders, const StudySize& size,
                                                      Random& random);

/// Inserts `count` catch trials into one participant's list of one phase. Each of `count` equal stretches gets one at a random
/// place. A catch trial is never first, and its fabric is never the true one before or after it.
std::vector<DesignTrial> withCatchTrials(const std::vector<DesignTrial>& trials, const Phase& phase, int fabrics, int count,
                                         Random& random);

}  // namespace protocols
