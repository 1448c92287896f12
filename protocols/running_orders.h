// Draws the order in which each participant gets the renderings of one phase.
#pragma once

#include <vector>

#include "protocols/random.h"

namespace protocols {

/// A label (an unnamed condition) and a fabric; both count from 0.
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

/// [participant][position]: each rendering once per participant. Over the study, ordered pairs of different labels and of
/// different fabrics follow one another equally often, and none repeats immediately. Each label is equally frequent in each
/// stretch of `labels` positions, each fabric in each stretch of `fabrics` positions, against practice and fatigue. Where this
/// is impossible, a bounded search comes as close as it can.
std::vector<std::vector<Rendering>> drawRunningOrders(const StudySize& size, Random& random);

}  // namespace protocols
