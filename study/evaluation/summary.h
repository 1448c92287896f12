// Means within fabrics, then over them, and the tests of equal means.
#pragma once

#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// One speaker's values, one entry a test pair in the order of the plan.
SpeakerResult summarise(const Speaker& speaker, const TestPlan& plan, const std::vector<Values>& ofPairs);

/// Of the measures that exist; undefined with the first reason where none does. Geometric means where the table says so.
stats::Value averageOf(Measure measure, std::span<const stats::Value> values);

/// Paired over the fabrics that both have; bounds are `fraction` of the measured grand mean.
MeanComparison compareMeans(const SpeakerResult& speaker, const SpeakerResult& measured, Measure measure, double fraction);

}  // namespace study::evaluation
