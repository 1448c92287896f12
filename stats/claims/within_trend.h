// A linear relation within each participant, such as that of answers with the trial number, tested over participants. It holds
// for new participants and the same fabrics.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "stats/kernels/value.h"
#include "stats/tests/t_tests.h"

namespace stats {

/// One answer of a participant.
struct TrendRow {
    std::size_t condition = 0;
    std::size_t fabric = 0;
    double covariate = 0;  ///< trial number, logarithm of the time, ...
    double value = 0;
};

/// A slope needs so many answers more than the model has effects.
inline constexpr std::size_t fewestFreeAnswers = 3;

/// Least-squares slope of the value on the covariate with effects of condition and fabric: coef of the covariate in R's
/// lm(value ~ covariate + condition + fabric). Undefined with a reason: too few answers, a covariate that does not vary beside
/// condition and fabric, numbers that are not finite.
Value adjustedSlope(std::span<const TrendRow> rows);

struct WithinTrend {
    std::vector<Value> slopes;  ///< of each participant
    TTest test;                 ///< of the slopes that exist against 0, with their mean and its 95 % interval
};

/// A test that does not exist, with its reason.
TTest noTest(const std::string& why);

/// One slope for each participant, and the one-sample t test of the slopes. The order of the rows does not matter.
WithinTrend withinTrend(std::span<const std::vector<TrendRow>> participants);

}  // namespace stats
