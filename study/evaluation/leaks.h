// The samples of a data set as a split has them, and what that split lets through: files that a model was trained on,
// doubled files, and pieces of fabric that are shown on both sides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rendering/fabrics/location_split.h"
#include "study/evaluation/test_plan.h"

namespace study::evaluation {

struct Placed {
    rendering::fabrics::SamplePlace place;
    rendering::fabrics::Part part = rendering::fabrics::Part::Training;
    std::string sha256;
    std::optional<rendering::fabrics::Footprint> footprint;  ///< none: its place is unknown
    bool leftOut = false;                                    ///< of the test
};

std::vector<Placed> placedSamples(const rendering::fabrics::Dataset& dataset, const PlanRequest& request, const Report& report);

/// Of the testing part; by fabric, of the fabrics that were held out.
bool isTested(const PlanRequest& request, const Placed& sample);
bool isHeldOut(const PlanRequest& request, const protocols::FabricId& fabric);

/// Counts, and marks what must be left out: what a model was trained on and, by location, what overlaps that.
Leaks findLeaks(std::vector<Placed>& samples, const PlanRequest& request);

}  // namespace study::evaluation
