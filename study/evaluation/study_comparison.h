// The signals generated for a study against the measured ones, beside the controls: the comparison of evaluate(), for the samples
// that the study shows.
#pragma once

#include "rendering/models/model_card_fields.h"
#include "stats/tests/t_tests.h"
#include "study/evaluation/evaluation.h"
#include "study/evaluation/known_samples.h"

namespace study::evaluation {

struct StudyComparisonRequest {
    std::vector<ShownSamples> shown;
    std::vector<rendering::models::GeneratedSignals> generated;  ///< for each of `shown`; a signal not generated is empty
    rendering::models::ModelCardFields model;                    ///< card of the generators
    std::filesystem::path control;                               ///< weights of an L1-only control; empty: none
    std::string datasetSha256;
    std::uint64_t seed = 1;  ///< of the draw of known samples
    unsigned threads = 0;    ///< 0: as many as the machine has; the results do not depend on it
};

/// Generated minus a control, one difference a fabric, by a paired t test.
struct MeasureDifference {
    Measure measure;
    stats::TTest test;
    stats::Value pHolm;  ///< corrected over the controls of this measure
};

struct ComparedSource {
    PredictorResult result;
    std::string name;                            ///< for tables
    std::optional<int> steps;                    ///< of training, for a model
    std::string whyUnfair;                       ///< reason why it is not a fair control; empty if it is one
    std::vector<MeasureDifference> differences;  ///< empty for generated signals and for an unfair control
};

struct StudyComparison {
    bool aligned = false;
    stats::Value rangeMm;                           ///< L of the structural similarity: the range of the measured maps
    std::vector<ComparedSource> sources;            ///< generated, its mean friction alone, then the controls
    int photographs = 0, presses = 0, strokes = 0;  ///< samples that the controls know
    std::vector<std::string> notes;                 ///< sentences
};

/// Measures that a study compares.
inline constexpr Measure studyMeasures[] = {
    Measure::FrictionMae, Measure::FrictionMaeOverMean, Measure::MeanFrictionError, Measure::FrictionSpectrum,
    Measure::Ssim,        Measure::SsimRegistered,      Measure::HeightSpectrum,    Measure::SqRatio};

/// Compares the signals. A measure that a data set cannot give is undefined with its reason. Throws badInput where a file of the
/// data set is broken.
StudyComparison compareStudy(const rendering::fabrics::Dataset& dataset, const StudyComparisonRequest& request,
                             const Report& report = {}, const Generate& generate = rendering::models::generate);

}  // namespace study::evaluation
