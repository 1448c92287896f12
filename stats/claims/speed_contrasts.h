// Speed and accuracy of choices between conditions: bits per second, balanced integration score and logarithm of the response
// time. Every test holds for new participants and these fabrics.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "stats/claims/claims.h"
#include "stats/claims/information_rate.h"
#include "stats/kernels/value.h"
#include "stats/tests/t_tests.h"

namespace stats {

/// The choices of one participant under one condition.
struct SpeedCell {
    ParticipantChoices choices;
    Value share;        ///< correct choices / choices
    Value meanSeconds;  ///< of the timed choices
    Value logSeconds;   ///< mean of the natural logarithms of the times
};

/// `correct`: 1 and 0. `seconds`: the times of those choices that have one; times that are not positive have no logarithm.
SpeedCell speedCell(std::span<const double> correct, std::span<const double> seconds);

/// The cells of a condition, one for each participant, in the same order under every condition.
using ConditionSpeedCells = std::vector<SpeedCell>;

/// Balanced integration scores [condition][participant], standardised over all cells that have a share and a time. The other
/// cells have no score.
std::vector<std::vector<Value>> scoresOf(std::span<const ConditionSpeedCells> conditions);

/// Mean difference of two conditions over the participants who have both.
struct SpeedDifference {
    TTest test;   ///< paired
    Value pHolm;  ///< after Holm's correction over the contrasts of the same measure
};

/// Conditions a - b.
struct SpeedContrastTests {
    SpeedDifference bitsPerSecond;  ///< of the participants' jackknife pseudo-values
    SpeedDifference score;          ///< of the balanced integration scores
    SpeedDifference logSeconds;     ///< of the participants' mean logarithms of the time; exp is a ratio of times
};

/// Two conditions that are compared, on choices that both have. A participant without such choices has empty cells.
struct SpeedPair {
    ConditionSpeedCells a, b;
    std::vector<Value> scoresOfA, scoresOfB;  ///< balanced integration scores
    std::string noBits = {};                  ///< why bits per second are not compared; empty: they are
};

/// The pair with these cells, in the order of the conditions' participants. The scores are standardised over all cells, where a
/// and b replace those of the contrast. `scores`: scoresOf(conditions), which are the same numbers if no choice is left out.
SpeedPair speedPair(std::span<const ConditionSpeedCells> conditions, std::span<const std::vector<Value>> scores,
                    const ContrastPair& contrast, ConditionSpeedCells a, ConditionSpeedCells b);

/// One row for each pair, in their order. `alternatives`: m >= 2.
std::vector<SpeedContrastTests> speedContrasts(std::span<const SpeedPair> pairs, int alternatives);

/// The same for contrasts that are compared on all choices. `scores`: scoresOf(conditions).
std::vector<SpeedContrastTests> speedContrasts(std::span<const ConditionSpeedCells> conditions,
                                               std::span<const std::vector<Value>> scores,
                                               std::span<const ContrastPair> contrasts, int alternatives);

}  // namespace stats
