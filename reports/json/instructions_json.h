// The factor "instruction" of a choice question, and the wordings of sentences that were read, as parts of statistics.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/analysis/instruction_analysis.h"
#include "reports/json/json_fields.h"

namespace reports {

/// "q1_instructions": speed and accuracy under each instruction, their contrasts, and the factors condition and instruction.
Json instructionsJson(const std::vector<std::string>& conditions, const InstructionAnalysis& analysis);

/// Adds "wordings" with their versions of the protocol and participants; nothing where there are no several ones.
void putWordings(Json& row, const std::vector<SentenceWording>& wordings);

}  // namespace reports
