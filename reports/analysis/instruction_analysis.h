// Speed and accuracy of a choice question under each instruction of its blocks: to be fast, to be accurate, a deadline. The
// instruction is a factor within participants. Two instructions are compared on the conditions and fabrics that a participant
// answered under both; on all choices where nobody did. Everything here holds for new participants and these fabrics.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/analysis/accuracy_by_speed.h"
#include "reports/analysis/speed_analysis.h"
#include "reports/cells/answer_cells.h"
#include "stats/anova/two_way_anova.h"
#include "stats/claims/speed_contrasts.h"

namespace reports {

/// The choices under one instruction.
struct InstructedSpeed {
    InstructionInfo instruction;
    std::size_t answers = 0;
    std::size_t timed = 0;                   ///< answers of which is known whether they were late
    std::size_t late = 0;                    ///< ... and that were; they are analysed like all others
    ConditionSpeed speed;                    ///< all conditions together; scores standardised over the instructions
    std::vector<ConditionSpeed> conditions;  ///< scores standardised over all conditions and instructions
    AccuracyBySpeed accuracy;                ///< conditional accuracy function under this instruction
};

/// Instructions a - b, over the participants who have both.
struct InstructionContrast {
    std::string a;
    std::string b;
    stats::SpeedDifference share;  ///< share correct
    stats::SpeedContrastTests tests;
};

struct InstructionAnalysis {
    std::vector<InstructedSpeed> instructions;  ///< in the order of the question; empty: none were given
    bool isComplete = false;  ///< everybody with an answer answered every condition x fabric under each instruction
    std::vector<InstructionContrast> contrasts;  ///< all pairs; Holm's correction over the contrasts of a measure
    /// Share correct of participants: condition, instruction, interaction. Over the fabrics that a participant answered under
    /// every condition and instruction.
    stats::TwoWayAnova shares;
    stats::TwoWayAnova logSeconds;  ///< ... mean logarithm of the response time
};

/// Empty where the answers name no instruction.
InstructionAnalysis analyseInstructions(const StudyData& data, const std::string& question, const RightOrWrong& scoring);

}  // namespace reports
