// Samples of a data set with their part in the split, and the leaks of the split: files that a model was trained on,
// duplicate files, and places on the fabric that occur in both parts.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rendering/fabrics/location_split.h"
#include "study/evaluation/test_plan.h"

namespace study::evaluation {

/// A sample with its part in the split and its place on the fabric.
struct PlacedSample {
    rendering::fabrics::SamplePlace place;
    rendering::fabrics::Part part = rendering::fabrics::Part::Training;
    std::string sha256;
    std::optional<rendering::fabrics::Footprint> footprint;  ///< none: the place is unknown
    bool leftOut = false;                                    ///< excluded from the test
};

std::vector<PlacedSample> placedSamples(const rendering::fabrics::Dataset& dataset, const PlanRequest& request,
                                        const Report& report);

/// Whether the sample is in the testing part; in the split by fabric, only held-out fabrics are tested.
bool isTested(const PlanRequest& request, const PlacedSample& sample);
bool isHeldOut(const PlanRequest& request, const protocols::FabricId& fabric);

/// Counts the leaks and marks the samples to leave out: those a model was trained on and, in the split by location, those that
/// overlap a training sample.
Leaks findLeaks(std::vector<PlacedSample>& samples, const PlanRequest& request);

/// How many photographs of each fabric have the bytes of a file that a model was trained on. Fabrics without one are absent.
/// `trainedOn`: SHA-256 of the files, sorted.
std::map<protocols::FabricId, int> photographsTrainedOn(const rendering::fabrics::Dataset& dataset,
                                                        const std::vector<std::string>& trainedOn);

}  // namespace study::evaluation
