// The claims of a question as rows of results.json, and the mixed models behind them as parts of statistics.json.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/question_claims.h"
#include "reports/json/json_members.h"

namespace reports {

/// Gives the question's rows of the arrays "omnibus", "above_chance" and "claims".
void addOmnibus(const TakeRow& take, const std::string& question, const QuestionClaims& claims);
void addAboveChance(const TakeRow& take, const std::string& question, const QuestionClaims& claims);
void addClaims(const TakeRow& take, const std::string& question, const std::vector<std::string>& fabrics,
               const QuestionClaims& claims);

}  // namespace reports
