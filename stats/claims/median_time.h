// The 95 % interval of a median response time over participants.
#pragma once

#include <span>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// `seconds`: the response times of each participant; who has none is left out. The median is that of all times together. Its
/// logarithm varies with the participants, so the interval is log median ± Student's t x standard error of the participants' own
/// log medians, turned back into seconds. It holds for new participants and these fabrics. Measured coverage:
/// 93 to 96 % of 4,000 studies of 5, 10 and 20 participants, 7 choices each, log-normal and Wald times with persons that differ
/// (tests/stats/speed_intervals_test.cpp). Undefined with a reason: fewer than 2 participants, participants that do not vary, a
/// median that is not positive.
Interval medianTimeCi95(std::span<const std::vector<double>> seconds);

}  // namespace stats
