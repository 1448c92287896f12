// How often a study that varies like this one, but has no true difference, claims one falsely.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/analysis/choice_analysis.h"
#include "reports/analysis/rating_analysis.h"
#include "stats/power/study_null.h"

namespace reports {

struct FalseClaimFinding {
    std::string question;
    double participantSd = 0;  ///< participant x condition, in the units of the kept table
    double fabricSd = 0;       ///< fabric x condition, likewise
    double one = 0;            ///< share of studies, one contrast: interpolated in the kept table, for the paper's size
    double any = 0;            ///< share of studies, any of all pairs: likewise
    std::optional<stats::FalseClaims> simulated;  ///< for this study's answers and contrasts; only where asked for
};

/// A question of which the report knows how its answers vary; none where its model was not fitted. Ratings: the SDs are brought
/// to the residual SD of the kept table, because only the ratio decides. `studies` to simulate; 0: none.
std::optional<FalseClaimFinding> falseClaimsOf(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                               const RatingAnalysis& ratings, std::size_t studies);
std::optional<FalseClaimFinding> falseClaimsOf(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                               const ChoiceAnalysis& choices, std::size_t studies);

}  // namespace reports
