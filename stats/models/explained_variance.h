// Shares of condition, the random effects and the residual in the variance of the answers, and R squared of the mixed models.
// Sources: Nakagawa and Schielzeth 2013, Nakagawa, Johnson and Schielzeth 2017.
#pragma once

#include <string>
#include <vector>

#include "stats/models/crossed_study.h"

namespace stats {

struct VarianceComponent {
    std::string name;  ///< "participant", "fabric:condition", "Residual"
    Value variance;    ///< squared units of the answers; of log odds for choices
    Value sd;
    Value share;  ///< of the sum of all components, without condition
    bool isZero = false;
};

struct ExplainedVariance {
    std::string why;  ///< empty when the model was fitted
    std::vector<VarianceComponent> components;
    Value conditionVariance;  ///< variance (n - 1) over the rows of the means that the model gives the conditions
    Value marginal;           ///< share of condition in condition and all components
    Value conditional;        ///< share of condition and the random effects: all but the residual
};

/// Of a linear mixed model. `study`: the answers that it was fitted to.
ExplainedVariance explainedVariance(const CrossedStudy& study, const RatingModel& fitted);

/// Of a logistic mixed model, on the scale of log odds. The residual is the variance of the standard logistic distribution,
/// pi^2 / 3. Where a condition is separated, condition has no finite variance, and the R squared are undefined.
ExplainedVariance explainedVariance(const CrossedStudy& study, const ChoiceModel& fitted);

}  // namespace stats
