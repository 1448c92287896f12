// The study's own models: ratings or choices of participants who each meet every fabric under every
// condition. Which random effects can be estimated follows from the data; what cannot is left out by name.
#pragma once

#include <string>
#include <vector>

#include "stats/models/logistic_mixed_model.h"
#include "stats/models/mixed_model.h"

namespace stats {

/// One row an answer. The order of the conditions is that of their levels.
struct CrossedStudy {
    Factor participant;
    Factor fabric;
    Factor condition;
    std::vector<double> values;  ///< ratings, or 1 and 0; NaN missing
};

/// A random effect, or a condition, that the data cannot tell anything about.
struct LeftOut {
    std::string name;
    std::string why;
};

struct RatingModel {
    std::string formula;  ///< as R writes it, without what was left out
    MixedModel model;
    FTest condition;
    std::vector<LeftOut> leftOut;
    std::vector<std::string> conditions;  ///< that have ratings: the first is the reference
};

/// Random intercepts of participant, fabric, participant x condition and fabric x condition. Left out are
/// groups of one level, groups with a level for every rating, interactions with a group left out.
RatingModel fitRatings(const CrossedStudy& study, const MixedModelOptions& options = {});

struct ChoiceModel {
    std::string formula;
    LogisticMixedModel model;
    std::vector<LeftOut> leftOut;
    std::vector<std::string> conditions;
};

/// Random intercepts of participant and fabric.
ChoiceModel fitChoices(const CrossedStudy& study, double confidence = 0.95);

}  // namespace stats
