// What a protocol can balance and detect, as values, and the function that computes them. The window itself draws no running
// order and knows no statistics. main and the tests supply the function.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocols/protocol.h"

namespace study::app {

struct SessionOutlook {
    /// How evenly something occurs in the running orders.
    struct Range {
        std::string what;
        int least = 0, most = 0;
    };
    /// The smallest effect that the study finds with a power of 80 %.
    struct Detectable {
        std::string question;
        bool isOfRatings = false;        ///< a difference of two conditions in scale points; else a share of right answers
        std::optional<double> smallest;  ///< empty if no effect is large enough
        std::string why;                 ///< the reason, if there is none
    };
    bool isBalanceDrawn = true;  ///< false for a study whose orders take long to draw
    std::vector<Range> balance;
    std::vector<Detectable> detects;
};

/// Called on a worker thread with a protocol without faults. Throws protocols::Error.
using LookAhead = std::function<SessionOutlook(const protocols::Protocol&)>;

}  // namespace study::app
