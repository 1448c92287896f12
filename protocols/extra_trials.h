// Presentations beyond a choice among fabrics: the one fabric of a same/different phase, and catch
// trials, whose glass stays blank.
#pragma once

#include <vector>

#include "protocols/counterbalancing.h"
#include "protocols/running_orders.h"
#include "protocols/trays.h"

namespace protocols {

/// The one fabric that lies on the tray, [participant][position]: the rendering's own in half of the
/// presentations (per label x fabric over participants, per participant x label and per participant x
/// fabric; counts that do not divide differ by at most one), else another, each other one equally often.
std::vector<std::vector<Tray>> drawSameDifferentTrays(const std::vector<std::vector<Rendering>>& orders, const StudySize& size,
                                                      Random& random);

/// Puts `count` catch trials into one participant's list of one phase: one at a drawn place of each of
/// `count` equal stretches, never first, and never of a fabric that is the true one next to it.
std::vector<DesignTrial> withCatchTrials(const std::vector<DesignTrial>& trials, const Phase& phase, int fabrics, int count,
                                         Random& random);

}  // namespace protocols
