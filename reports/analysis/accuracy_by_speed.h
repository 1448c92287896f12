// Conditional accuracy: how the share correct of a choice question depends on the response time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/cells/answer_cells.h"
#include "stats/claims/within_trend.h"

namespace reports {

/// Number of bins of all conditions together: the quarters of each participant's own response times.
inline constexpr std::size_t speedBins = 4;

/// The choices of one speed, over participants.
struct SpeedBin {
    std::size_t choices = 0;
    std::size_t participants = 0;
    stats::Value meanSeconds;  ///< mean of the participants' mean times
    stats::Value share;        ///< mean of the participants' shares correct
    stats::Interval ci95;      ///< Student's t over participants, within 0 and 1
};

/// The shares correct of one participant, from fast to slow.
struct ParticipantSpeed {
    std::string participant;
    std::vector<stats::Value> meanSeconds;
    std::vector<stats::Value> shares;
};

struct AccuracyBySpeed {
    std::string why;                                ///< reason where there are no bins
    std::vector<SpeedBin> bins;                     ///< speedBins of them, from fast to slow, over all conditions
    std::vector<ParticipantSpeed> participants;     ///< those with enough timed choices
    std::size_t conditionBins = 0;                  ///< bins of each participant's times under one condition: 4 or 2
    std::vector<std::vector<SpeedBin>> conditions;  ///< [condition][bin]; empty where a condition has none
    /// Share correct for a doubling of the response time, at equal condition, instruction and fabric.
    stats::WithinTrend trend;
};

/// A participant needs two timed choices a bin. With fewer than 8 choices under a condition that condition has two bins.
AccuracyBySpeed accuracyBySpeed(const StudyData& data, const AnswerCells& cells, const std::string& question);

}  // namespace reports
