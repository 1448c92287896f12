// Comparison of generated with measured signals. Four controls put the figures into context: a global constant, the mean of each
// fabric, the nearest training photograph, and the same fabric at another place. Averages are taken within a fabric first, then
// over fabrics.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "rendering/models/generation.h"
#include "stats/tests/equivalence.h"
#include "study/evaluation/measures.h"
#include "study/evaluation/test_plan.h"

namespace study::evaluation {

/// Source of predicted signals. GeneratedMean is the generated mean friction as a constant trace, as in condition h_g&f_g.
enum class PredictorKind { Generated, GeneratedMean, Against, GlobalConstant, FabricMean, Retrieval, AnotherPlace, Measured };

/// A source of predicted signals: a model or a control.
struct Predictor {
    PredictorKind kind = PredictorKind::Generated;
    std::string id;         ///< "generated", "against:NAME", "global_constant", …
    std::string name;       ///< for tables
    std::size_t model = 0;  ///< index in Evaluation::models of the model that predicts
};

/// Measures of one fabric.
struct FabricValues {
    protocols::FabricId fabric;
    int pairs = 0;
    Values values;  ///< means over the pairs of the fabric
};

/// Test whether predicted and measured means are equal. The unit is the fabric.
struct MeanComparison {
    double bound = 0;                    ///< bound of the equivalence test, in the unit of the measure
    stats::EquivalenceTest equivalence;  ///< includes the paper's t test (tDifference)
};

/// Results of one predictor.
struct PredictorResult {
    Predictor predictor;
    std::vector<FabricValues> fabrics;
    Values mean;                  ///< means over fabrics
    Intervals ci95;               ///< 95 % intervals of the means; the unit is the fabric
    MeanComparison friction, sq;  ///< comparison with the measured means
};

struct ModelUsed {
    std::string name, file, sha256;
    std::string losses;  ///< "default", "reference", "l1-only"
    std::vector<std::string> heldOut;
    int steps = 0;  ///< of its training
    /// What its training differs in from that of the evaluated model, besides the losses (trainingDifferences() in
    /// rendering/models/fair_control.h). If not empty, it is not a fair control.
    std::vector<std::string> differences;
};

struct EvaluationRequest {
    std::filesystem::path model;                 ///< empty: the shipped weights
    std::vector<std::filesystem::path> against;  ///< further models to compare with
    std::optional<SplitKind> split;              ///< none: location where the model was so trained on this set, else sample
    std::optional<std::uint64_t> splitSeed;      ///< none: the seed of the model's training
    rendering::models::Quality quality = rendering::models::Quality::Balanced;
    std::optional<int> samplesPerFabric;
    double boundsFraction = 0.10;  ///< equivalence bounds as a fraction of the measured grand mean
    unsigned threads = 0;          ///< 0: as many as the machine has; the results do not depend on it
};

struct Evaluation {
    std::string dataset;
    bool aligned = false;
    SplitKind split = SplitKind::Sample;
    std::uint64_t splitSeed = 1;
    double boundsFraction = 0.10;
    std::vector<ModelUsed> models;                                          ///< the evaluated model, then the others
    int pairs = 0, fabrics = 0;                                             ///< number of tested pairs and fabrics
    int trainingPhotographs = 0, trainingPresses = 0, trainingStrokes = 0;  ///< training samples that the controls use
    Leaks leaks;
    stats::Value rangeMm;                     ///< L of SSIM: highest minus lowest point of all measured test maps
    stats::Value noiseFloor;                  ///< friction MAE/mean of a constant at the mean of each stroke
    std::vector<PredictorResult> predictors;  ///< generated, other models, controls, measured
    std::vector<std::string> notes;

    const PredictorResult* predictor(PredictorKind kind) const;  ///< first of this kind; null if none
    /// Reason why a predictor is not a fair control, such as "trained with 800 steps (the model: 6,000)"; empty if it is one.
    std::string whyUnfair(const PredictorResult& predictor) const;
};

/// "trained with 800 steps (the model: 6,000), another split"; empty if there are no differences.
std::string unfairness(const std::vector<std::string>& differences);

/// Function that generates signals; the program uses rendering::models::generate().
using Generate = std::function<std::vector<rendering::models::GeneratedSignals>(
    std::span<const rendering::models::InputPhotograph>, const rendering::models::GenerationOptions&)>;

/// Evaluates the models. Throws badInput if there is nothing to test or if the split does not suit the model.
Evaluation evaluate(const rendering::fabrics::Dataset& dataset, const EvaluationRequest& request, const Report& report = {},
                    const Generate& generate = rendering::models::generate);

}  // namespace study::evaluation
