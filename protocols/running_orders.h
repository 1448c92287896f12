// The order in which each participant of a study meets the renderings of one phase.
#pragma once

#include <vector>

#include "protocols/random.h"

namespace protocols {

/// A label (stands for a condition) on a fabric; both count from 0.
struct Rendering {
    int label = 0;
    int fabric = 0;
    bool operator==(const Rendering&) const = default;
};

struct StudySize {
    int participants = 1;
    int labels = 1;
    int fabrics = 1;
};

/// [participant][position]: each rendering once a participant. Over the study each ordered pair of
/// different labels, and of different fabrics, follows one another equally often; neither repeats
/// immediately; each label is equally often in each stretch of `labels` positions and each fabric in
/// each stretch of `fabrics` positions (practice and fatigue). Where a demand cannot be met, as near
/// to it as a bounded search comes.
std::vector<std::vector<Rendering>> drawRunningOrders(const StudySize& size, Random& random);

}  // namespace protocols
