// What speaks beside the generator, so that its figures mean something: two constants, the nearest known photograph, and the
// judge that tells fabrics apart. All are made from the training part alone.
#pragma once

#include <memory>
#include <vector>

#include "study/evaluation/identification.h"
#include "study/evaluation/measured_signals.h"
#include "study/evaluation/test_plan.h"

namespace study::evaluation {

/// The training photograph nearest to a test photograph, and a press and a stroke of its fabric: of the same index where the
/// data set is aligned, else drawn by seed.
struct Retrieved {
    Sample photograph;
    std::optional<Sample> press, stroke;
};

struct Judge {
    Identifier byHeight, byFriction, byBoth;
};

struct Controls {
    stats::Value heightMm, friction;                               ///< means over the fabrics that are not held out
    std::vector<stats::Value> heightMmOfFabric, frictionOfFabric;  ///< undefined for a held-out fabric
    std::unique_ptr<Judge> judge;
    std::vector<Retrieved> retrieved;  ///< one a test pair; empty where no photograph is left to retrieve
    std::string whyNothingRetrieved;
    int presses = 0, strokes = 0, photographs = 0;  ///< of the training part that were read
    int featureSide = 0;                            ///< px of the square that height features are taken of
};

/// At most so many training presses of a fabric are read, drawn by seed: more would change no digit that is shown.
inline constexpr std::size_t mostPressesOfFabric = 60;

Controls learnControls(const rendering::fabrics::Dataset& dataset, const MeasuredSignals& measured, const TestPlan& plan,
                       const PlanRequest& request, const Report& report = {});

}  // namespace study::evaluation
