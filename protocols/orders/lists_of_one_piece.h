// Draws the lists of a phase of ratings, or of same or different, that has catch trials or anchors.
#pragma once

#include <vector>

#include "protocols/orders/counterbalancing.h"
#include "protocols/orders/running_orders.h"

namespace protocols {

/// [participant][presentation]. What lies on the trays is drawn first (laid_pieces.h). The conditions follow: over the study
/// ordered pairs of conditions, and conditions in each stretch, are even without the additional presentations. Conditions of
/// repetitions and images of mismatched presentations are nearly even over the study. With three labels or more, a repetition has
/// another one than its neighbours where that is possible.
std::vector<std::vector<DesignTrial>> drawListsOfOnePiece(const Phase& asked, int phase, const StudySize& size, int blockLength,
                                                          Random& orderDraws, Random& trayDraws);

}  // namespace protocols
