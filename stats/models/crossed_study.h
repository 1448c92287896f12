// The models of the study: ratings or choices of participants, crossed with fabrics and conditions. The data decide
// which random effects can be estimated; those that cannot be are left out and named.
#pragma once

#include <string>
#include <vector>

#include "stats/models/logistic_mixed_model.h"
#include "stats/models/mixed_model.h"
#include "stats/models/ordinal_mixed_model.h"

namespace stats {

/// Answers, one in each row. The levels of `condition` give the order of the conditions.
struct CrossedStudy {
    Factor participant;
    Factor fabric;
    Factor condition;
    std::vector<double> values;  ///< ratings, or 1 and 0; NaN missing
};

/// A random effect or a condition that cannot be estimated, and the reason.
struct LeftOut {
    std::string name;
    std::string why;
};

struct RatingModel {
    std::string formula;  ///< in R's notation, without the effects left out
    MixedModel model;
    FTest condition;
    std::vector<LeftOut> leftOut;
    std::vector<std::string> conditions;  ///< conditions that have ratings; the first is the reference
};

/// Linear mixed model with random intercepts of participant, fabric, participant x condition and fabric x
/// condition. Groups of one level, groups with a level for every rating, and interactions with a group that is
/// left out are left out.
RatingModel fitRatings(const CrossedStudy& study, const MixedModelOptions& options = {});

/// Reason why the model holds for no other participants or fabrics: it saw one. Empty where it saw several.
std::string whyNotForOthers(const std::vector<LeftOut>& leftOut);

/// The test of all conditions as one for fabrics like these; none where whyNotForOthers() has a reason.
FTest conditionForOthers(const RatingModel& model);

struct ChoiceModel {
    std::string formula;
    LogisticMixedModel model;
    std::vector<LeftOut> leftOut;
    std::vector<std::string> conditions;
};

enum class ChoiceTerms {
    MainEffects,       ///< random intercepts of participant and fabric
    WithInteractions,  ///< and of participant x condition and fabric x condition
};

/// Logistic mixed model. Refused with a reason where a step of the fit would cost more than mostLaplaceCost.
ChoiceModel fitChoices(const CrossedStudy& study, ChoiceTerms terms = ChoiceTerms::MainEffects, double confidence = 0.95);

struct OrdinalRatingModel {
    std::string formula;
    OrdinalMixedModel model;
    std::vector<LeftOut> leftOut;
    std::vector<std::string> conditions;  ///< conditions that have ratings; the first is the reference
};

/// Cumulative logit mixed model of ratings, with random intercepts of participant and fabric. Each different rating is a
/// category: round them first (roundedHalvesUp).
OrdinalRatingModel fitOrdinal(const CrossedStudy& study, const OrdinalOptions& options = {});

}  // namespace stats
