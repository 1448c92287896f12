// How large the effects of a question are, how well the participants agree, and where the variance of the answers lies. None of
// these numbers decides a claim.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/analysis/question_claims.h"
#include "reports/cells/answer_cells.h"
#include "stats/models/explained_variance.h"
#include "stats/tests/bayes_factor.h"
#include "stats/tests/intraclass.h"
#include "stats/tests/repeated_measures.h"

namespace reports {

/// Participants as raters of the stimuli (fabric x condition).
struct RaterAgreement {
    std::size_t stimuli = 0;           ///< rated by every rater
    std::size_t raters = 0;            ///< participants who rated at least half of the stimuli
    std::vector<std::string> leftOut;  ///< the other participants
    stats::IntraclassCorrelations icc;
    stats::IntraclassIntervals ci95;
};

/// Evidence from the participants' mean differences, for these fabrics.
struct ContrastEvidence {
    std::string a;
    std::string b;
    bool planned = false;
    std::size_t participants = 0;
    stats::Value t;
    stats::JzsBayesFactor factor;
};

/// Larger families have no Bayes factors: a table of so many informs nobody.
inline constexpr std::size_t mostBayesFactors = 100;

struct QuestionEffects {
    std::optional<RaterAgreement> agreement;  ///< ratings only
    std::string noEvidence;                   ///< why there are no Bayes factors; empty where there are
    std::vector<ContrastEvidence> evidence;   ///< in the order of the claims
    std::size_t completeParticipants = 0;     ///< with a mean in every condition
    stats::Value partialEtaSquared;           ///< of condition, on the participants' means
    stats::Value generalizedEtaSquared;       ///< Olejnik and Algina 2003, Bakeman 2005
    stats::ExplainedVariance variance;        ///< of the mixed model with all interactions; log odds for choices
    std::vector<stats::LeftOut> leftOut;      ///< its random effects that cannot be estimated
};

QuestionEffects ratingEffects(const StudyData& data, const AnswerCells& cells, const std::string& question,
                              const QuestionClaims& claims, const stats::RepeatedMeasuresAnova& anova,
                              const stats::CrossedStudy& answers, const stats::RatingModel& model);

/// `model`: with the interactions.
QuestionEffects choiceEffects(const QuestionClaims& claims, const stats::RepeatedMeasuresAnova& anova,
                              const stats::CrossedStudy& answers, const stats::ChoiceModel& model);

/// The variance component of this name; null where there is none.
const stats::VarianceComponent* componentOf(const QuestionEffects& effects, const std::string& name);

/// What the interaction of fabric and condition means for other fabrics: its share, and the SD over fabrics of a difference of
/// two conditions, with its unit ("scale points", "log odds"); or why nothing is known.
std::string fabricSentence(const QuestionEffects& effects, const std::string& unit);

/// What d' follows from: the share correct of a choice, or the hits and false alarms of a same-different question.
enum class DPrimeRule { OfShare, OfHits };

/// d' of the mean share correct under one condition, for one generalisation, and the interval that follows from that of the
/// share. Its low end is 0 where the share may be at chance; its high end is infinite where every choice may be right. In a
/// same-different question d' and its interval are those of hits and false alarms (match_sensitivity.h).
struct ClusteredSensitivity {
    std::string condition;
    stats::Generalisation generalisation = stats::Generalisation::TheseFabrics;
    stats::Value share;
    stats::Interval shareCi95;
    stats::Value dPrime;
    stats::Interval ci95;
};

/// One for each finding against chance, in their order. `alternatives`: m of the choice.
std::vector<ClusteredSensitivity> clusteredSensitivities(const QuestionClaims& claims, int alternatives);

}  // namespace reports
