// The claims of a question as rows of results.json, and the mixed models behind them as parts of statistics.json.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/question_claims.h"
#include "reports/json/json_fields.h"

namespace reports {

/// Appends the question's rows to the arrays "omnibus", "above_chance" and "claims".
void addOmnibus(Json& rows, const std::string& question, const QuestionClaims& claims);
void addAboveChance(Json& rows, const std::string& question, const QuestionClaims& claims);
void addClaims(Json& rows, const std::string& question, const std::vector<std::string>& fabrics, const QuestionClaims& claims);

}  // namespace reports
