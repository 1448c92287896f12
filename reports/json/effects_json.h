// Effect sizes, evidence, reliability and variance components as objects of statistics.json.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/question_effects.h"
#include "reports/json/json_fields.h"

namespace reports {

/// The top-level keys of statistics.json that putEffects writes.
std::vector<std::string> effectKeys();

/// Adds the question under "reliability" (ratings only), "bayes_factors", "effect_sizes", "r_squared" and "variance_components".
/// `unit`: of the standard deviations.
void putEffects(Json& statistics, const std::string& question, const QuestionEffects& effects, const std::string& unit);

/// Rows of d' with intervals from the clustered intervals of the share, by condition.
Json clusteredSensitivityRows(const std::vector<ClusteredSensitivity>& sensitivities, const std::string& condition,
                              DPrimeRule rule);

}  // namespace reports
