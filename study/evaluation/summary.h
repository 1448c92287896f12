// Means within fabrics, then over fabrics, and the tests of equal means.
#pragma once

#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// Summarises one predictor. `ofPairs`: its values for each test pair, in the order of the plan.
PredictorResult summarise(const Predictor& predictor, const TestPlan& plan, const std::vector<Values>& ofPairs);

/// Mean of the values that exist, geometric if the table of measures says so. Undefined with the first reason if none exists.
stats::Value averageOf(Measure measure, std::span<const stats::Value> values);

/// 95 % interval of averageOf(): Student's t, of the logarithms where the mean is geometric; Wilson's of shares whose values are
/// all 0 or 1. Undefined with a reason below two values. A share ends at 0 and 1.
stats::Interval intervalOf(Measure measure, std::span<const stats::Value> values);

/// Paired test over the fabrics that both results have. The bounds are `fraction` of the measured grand mean.
MeanComparison compareMeans(const PredictorResult& predictor, const PredictorResult& measured, Measure measure, double fraction);

}  // namespace study::evaluation
