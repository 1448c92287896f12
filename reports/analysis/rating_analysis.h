// A question answered by numbers on a scale, analysed: means, tests of all conditions at once, and pairs of conditions.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/analysis/model_contrasts.h"
#include "reports/analysis/ordinal_ratings.h"
#include "reports/analysis/pair_comparisons.h"
#include "reports/analysis/question_claims.h"
#include "reports/analysis/question_effects.h"
#include "reports/cells/answer_cells.h"
#include "reports/data/analysis_options.h"
#include "stats/models/crossed_study.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"

namespace reports {

/// One condition.
struct ConditionRatings {
    std::size_t ratings = 0;
    stats::Value mean;  ///< over ratings
    stats::Value sd;    ///< over ratings
    std::size_t participants = 0;
    stats::Value meanOfParticipants;     ///< mean of the participants' means; differs from `mean` where answers are missing
    stats::Interval ci95;                ///< its interval, Student's t
    stats::Value withinHalfWidth;        ///< within-subject interval (Morey 2008), complete participants
    std::vector<stats::Value> byFabric;  ///< mean over the participants' ratings, in the order of the study's fabrics
};

struct ParticipantMeans {
    std::string participant;
    std::vector<stats::Value> means;  ///< by condition
};

/// Tests of means over all answers of each participant under a condition: the definition of the reference numbers behind
/// statistics.json. Where answers are missing, these tests confuse fabrics and repetitions with conditions.
struct AnsweredFabricTests {
    std::vector<std::string> completeParticipants;
    stats::RepeatedMeasuresAnova anova;
    stats::FriedmanTest friedman;
    std::vector<PairComparison> comparisons;
    std::vector<PairEquivalence> equivalences;
};

struct RatingAnalysis {
    NumberOnScale scale;                       ///< what figures of the question show
    std::vector<ConditionRatings> conditions;  ///< in the order of the study's conditions
    std::vector<std::string> completeParticipants;
    std::vector<ParticipantMeans> participants;
    stats::RepeatedMeasuresAnova anova;
    stats::FriedmanTest friedman;
    stats::RatingModel model;
    std::vector<PairComparison> comparisons;
    std::vector<PairEquivalence> equivalences;
    std::optional<AnsweredFabricTests> overAnswered;  ///< where they differ from the tests above
    QuestionClaims claims;
    std::vector<ModelContrast> modelContrasts;
    LeaveOneFabricOut leaveOneFabricOut;
    QuestionEffects effects;
    OrdinalRatings ordinal;
};

/// Whether a mean of participants differs from the mean over ratings under some condition.
bool haveUnequalCounts(const RatingAnalysis& ratings);

/// `scale` holds every rating of the question.
RatingAnalysis analyseRatings(const StudyData& data, const AnswerCells& cells, const std::string& question,
                              const NumberOnScale& scale, Depth depth);

}  // namespace reports
