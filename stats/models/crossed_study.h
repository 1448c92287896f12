// The models of the study: ratings or choices of participants, crossed with fabrics and conditions. The data decide
// which random effects can be estimated; those that cannot be are left out and named.
#pragma once

#include <string>
#include <vector>

#include "stats/models/logistic_mixed_model.h"
#include "stats/models/mixed_model.h"

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

/// The time of a logistic fit grows with the cube of the number of its random effects.
inline constexpr std::size_t mostCrossedEffects = 500;

/// Logistic mixed model. With interactions it is refused with a reason for more than mostCrossedEffects random effects.
ChoiceModel fitChoices(const CrossedStudy& study, ChoiceTerms terms = ChoiceTerms::MainEffects, double confidence = 0.95);

}  // namespace stats
