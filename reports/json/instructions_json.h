// The factor "instruction" of a choice question, as a part of statistics.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/analysis/instruction_analysis.h"
#include "reports/json/json_fields.h"

namespace reports {

/// "q1_instructions": speed and accuracy under each instruction, their contrasts, and the factors condition and instruction.
Json instructionsJson(const std::vector<std::string>& conditions, const InstructionAnalysis& analysis);

}  // namespace reports
