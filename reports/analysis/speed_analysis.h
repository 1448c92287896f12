// Speed and accuracy of a choice question taken together, by condition.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/answer_cells.h"
#include "stats/kernels/value.h"

namespace reports {

struct ConditionSpeed {
    stats::Value medianSeconds;
    stats::Value bitsPerSecond;
    stats::Value balancedIntegrationScore;  ///< mean over the participants' cells
};

/// In the order of the conditions.
std::vector<ConditionSpeed> analyseSpeed(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                         int alternatives);

/// A study without a choice question: every number is undefined.
std::vector<ConditionSpeed> speedWithoutChoices(const StudyData& data);

}  // namespace reports
