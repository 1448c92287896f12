// Generated against measured signals, beside what gives the figures meaning: a global constant, each fabric's mean, the nearest
// known photograph, and the same fabric at another place. Averages are taken within a fabric first, then over fabrics.
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

/// GeneratedMean: the generated mean friction alone, a constant trace: what the condition h_g&f_g shows of friction.
enum class SpeakerKind { Generated, GeneratedMean, Against, GlobalConstant, FabricMean, Retrieval, AnotherPlace, Measured };

struct Speaker {
    SpeakerKind kind = SpeakerKind::Generated;
    std::string id;    ///< "generated", "against:NAME", "global_constant", ...
    std::string name;  ///< for people
};

struct FabricValues {
    protocols::FabricId fabric;
    int pairs = 0;
    Values values;  ///< means over its pairs
};

/// Are the means over fabrics of what was generated and measured the same? Unit: fabric.
struct MeanComparison {
    double bound = 0;                    ///< of the equivalence test, in the measure's unit
    stats::EquivalenceTest equivalence;  ///< with the paper's t test beside it (tDifference)
};

struct SpeakerResult {
    Speaker speaker;
    std::vector<FabricValues> fabrics;
    Values mean;                  ///< over fabrics
    MeanComparison friction, sq;  ///< against the measured means
};

struct ModelUsed {
    std::string name, file, sha256;
    std::string losses;  ///< "default", "reference", "l1-only"
    std::vector<std::string> heldOut;
};

struct EvaluationRequest {
    std::filesystem::path model;                 ///< empty: the shipped weights
    std::vector<std::filesystem::path> against;  ///< further models, beside it
    SplitKind split = SplitKind::Sample;
    std::optional<std::uint64_t> splitSeed;  ///< none: the model's own
    rendering::models::Quality quality = rendering::models::Quality::Balanced;
    std::optional<int> samplesPerFabric;
    double boundsFraction = 0.10;  ///< of the measured grand mean: equivalence bounds
    unsigned threads = 0;          ///< 0: as many as the machine has; changes no number
};

struct Evaluation {
    std::string dataset;
    bool aligned = false;
    SplitKind split = SplitKind::Sample;
    std::uint64_t splitSeed = 1;
    double boundsFraction = 0.10;
    std::vector<ModelUsed> models;                                          ///< the model, then those against it
    int pairs = 0, fabrics = 0;                                             ///< tested
    int trainingPhotographs = 0, trainingPresses = 0, trainingStrokes = 0;  ///< that the controls know
    Leaks leaks;
    stats::Value rangeMm;                 ///< L of SSIM: from the lowest to the highest point of all measured test maps
    stats::Value noiseFloor;              ///< friction MAE/mean of a constant at each stroke's own mean
    std::vector<SpeakerResult> speakers;  ///< generated, against, the controls, measured
    std::vector<std::string> notes;

    const SpeakerResult* speaker(SpeakerKind kind) const;  ///< the first of its kind
};

/// How signals are generated; the program asks rendering::models::generate().
using Generate = std::function<std::vector<rendering::models::GeneratedSignals>(
    std::span<const rendering::models::PhotographToTouch>, const rendering::models::GenerationOptions&)>;

/// Throws badInput where there is nothing to test or the model cannot be tested so.
Evaluation evaluate(const rendering::fabrics::Dataset& dataset, const EvaluationRequest& request, const Report& report = {},
                    const Generate& generate = rendering::models::generate);

}  // namespace study::evaluation
