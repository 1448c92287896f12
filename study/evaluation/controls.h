// Controls beside the generator: a global constant, the mean of each fabric, and the nearest training photograph. Also the
// classifiers that identify a fabric from its signals. All of them use the training part only.
#pragma once

#include <memory>
#include <vector>

#include "study/evaluation/identification.h"
#include "study/evaluation/measured_signals.h"
#include "study/evaluation/test_plan.h"

namespace study::evaluation {

/// The training photograph nearest to a test photograph, with a press and a stroke of its fabric. In an aligned data set they
/// have the same index; otherwise they are drawn by seed.
struct RetrievedSamples {
    PlannedSample photograph;
    std::optional<PlannedSample> press, stroke;
};

/// Classifiers of the fabric, by signal.
struct Identifiers {
    Identifier byHeight, byFriction, byBoth;
};

struct Controls {
    stats::Value heightMm, friction;                               ///< means over the fabrics that are not held out
    std::vector<stats::Value> heightMmOfFabric, frictionOfFabric;  ///< undefined for a held-out fabric
    std::unique_ptr<Identifiers> identifiers;
    std::vector<RetrievedSamples> retrieved;  ///< one for each test pair; empty if there is no training photograph
    std::string whyNoRetrieval;
    int presses = 0, strokes = 0, photographs = 0;  ///< training samples that were read
    int featureSide = 0;                            ///< side of the square for height features, px
};

/// Largest number of training presses read for a fabric, drawn by seed. More presses change no printed digit.
inline constexpr std::size_t maxPressesPerFabric = 60;

/// Fits the controls on the training part.
Controls fitControls(const rendering::fabrics::Dataset& dataset, const MeasuredSignals& measured, const TestPlan& plan,
                     const PlanRequest& request, const Report& report = {});

}  // namespace study::evaluation
