// The claims of the report about one question: contrasts of conditions, choices above chance, and all conditions at once. Each
// is made for these fabrics and for fabrics like these.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/cells/answer_cells.h"
#include "reports/data/analysis_options.h"
#include "stats/claims/claims.h"
#include "stats/models/crossed_study.h"
#include "stats/tests/repeated_measures.h"

namespace reports {

/// A contrast after one participant or one fabric is left out of the whole family.
struct LeftOneOut {
    std::string leftOut;  ///< id of the participant or fabric
    stats::Value estimate;
    stats::Interval ci90;
    stats::Verdict verdict = stats::Verdict::NotDecided;
};

struct ContrastFinding {
    std::string a;
    std::string b;
    bool planned = false;  ///< in the protocol's order and sign
    bool primary = false;  ///< the protocol's primary contrast
    stats::Generalisation generalisation = stats::Generalisation::TheseFabrics;
    stats::ContrastClaim claim;
    std::vector<stats::Value> byFabric;          ///< mean difference on each fabric of the study
    std::vector<LeftOneOut> withoutFabric;       ///< both empty for more than mostContrastsLeftOut contrasts
    std::vector<LeftOneOut> withoutParticipant;  ///< empty for more than mostLeftOut participants
};

/// Left out also where the depth is Quick. Leaving out one participant of many changes nothing, and takes as many analyses as
/// there are participants.
inline constexpr std::size_t mostLeftOut = 60;
/// Larger families are analysed with everybody only.
inline constexpr std::size_t mostContrastsLeftOut = 100;

struct ChanceFinding {
    std::string condition;
    stats::Generalisation generalisation = stats::Generalisation::TheseFabrics;
    stats::ChanceClaim claim;
};

/// A test of all conditions at once.
struct OmnibusFinding {
    stats::Generalisation generalisation = stats::Generalisation::TheseFabrics;
    stats::FTest test;
};

struct QuestionClaims {
    std::optional<stats::Bounds> bounds;     ///< of equivalence; none for choices
    std::vector<ContrastFinding> contrasts;  ///< the planned contrasts, or all pairs; each twice, these fabrics first
    std::vector<ChanceFinding> aboveChance;  ///< conditions in the order of the study, each twice; choices only
    std::vector<OmnibusFinding> omnibus;     ///< these fabrics, fabrics like these
};

/// `anova`: the repeated-measures analysis of the participants' means; `model`: the mixed model of the same answers, in which
/// choices count as 0 and 1. `alternatives`: answers to choose from; none for ratings. `noChance`: for each condition why it is
/// not tested against chance, see whyNoChance(); empty texts, or none for ratings.
QuestionClaims claimsOf(const StudyData& data, const AnswerCells& cells, const std::string& question,
                        std::optional<int> alternatives, const stats::RepeatedMeasuresAnova& anova,
                        const stats::RatingModel& model, Depth depth, const std::vector<std::string>& noChance = {});

/// The means of the cells of a question, by condition, participant and fabric of the study. They are those of all answers of a
/// cell, also where repetitions are missing.
stats::AnswerCube answerCube(const StudyData& data, const AnswerCells& cells, const std::string& question,
                             stats::AnswerValues kind);

/// Whether the family is that of the planned contrasts. It is not where none is planned, or where the answers have no planned
/// contrast's conditions.
bool arePlanned(const QuestionClaims& claims);

/// "these_fabrics" or "fabrics_like_these".
std::string nameOf(stats::Generalisation generalisation);

}  // namespace reports
