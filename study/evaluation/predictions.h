// Predictions of every predictor for one test pair, and their comparison with the measured signals.
#pragma once

#include <memory>

#include "study/evaluation/controls.h"
#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// Measured signals of a pair. Keeps only the features of the map; the map itself is read again when needed.
struct MeasuredPair {
    std::optional<HeightFeatures> heightFeatures;
    double lowestMm = 0, highestMm = 0;
    std::optional<Trace> trace;
};

/// Inputs shared by all pairs.
struct EvaluationContext {
    const rendering::fabrics::Dataset& dataset;
    const MeasuredSignals& measured;
    const TestPlan& plan;
    const Controls& controls;
};

MeasuredPair measurePair(const EvaluationContext& context, const TestPair& pair);

/// L of the structural similarity: highest minus lowest point of all measured maps. Undefined if there is none, or if all are
/// flat.
stats::Value rangeOf(const std::vector<MeasuredPair>& pairs);

/// Signals predicted for a pair. A missing height or trace has its reason.
struct Prediction {
    std::optional<HeightMap> height;
    std::optional<Trace> trace;
    std::string whyNoHeight, whyNoTrace;
    std::optional<rendering::models::FrictionInterval> meanFriction = {};  ///< 90 % interval, where the predictor gives one
};

Prediction predictByModel(const EvaluationContext& context, const TestPair& pair,
                          const rendering::models::GeneratedSignals& generated);
/// The generated mean friction as a constant trace.
Prediction predictByMean(const rendering::models::GeneratedSignals& generated, const MeasuredPair& measured);
Prediction predictByControl(const EvaluationContext& context, PredictorKind kind, std::size_t pair, const MeasuredPair& measured);

/// All measures of one prediction for one pair. `partner`: the measured map; empty if there is none.
Values compare(const EvaluationContext& context, const TestPair& pair, const MeasuredPair& measured, const HeightMap& partner,
               const Prediction& prediction, double rangeMm);
/// Values of the measured signals themselves: identification as an upper limit, and the measured means.
Values valuesOfMeasured(const EvaluationContext& context, const TestPair& pair, const MeasuredPair& measured);

/// The measured map of the press at its own pitch; empty if there is none.
HeightMap measuredMap(const EvaluationContext& context, const TestPair& pair);

}  // namespace study::evaluation
