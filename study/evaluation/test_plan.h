// Plan of an evaluation: the test photographs, the measured presses and strokes they are compared with, and the leaks of the
// split. A leak is a test sample, or its place on the fabric, that was also used for training.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rendering/fabrics/dataset.h"

namespace study::evaluation {

using rendering::fabrics::Modality;

/// Reports the progress of long work; called by one thread at a time.
using Report = std::function<void(const std::string& stage, int done, int total)>;

/// How test samples are chosen. Augmented is the paper's split after augmentation, in which every part has copies of every
/// original. It leaves no sample out of the test and counts those a model was trained on, so its figures also measure memory.
enum class SplitKind { Sample, Location, Fabric, Augmented };
/// "sample", "location", "fabric" or "augmented".
std::string_view nameOf(SplitKind kind);

/// One file of the data set.
struct PlannedSample {
    protocols::FabricId fabric;
    Modality modality = Modality::Visual;
    int index = 0;
    std::optional<double> rotationDeg;
    std::string sha256;
};

/// Training and test samples of one fabric.
struct PlannedFabric {
    protocols::FabricId fabric;
    bool heldOut = false;  ///< not used to train the models, so the controls must not use it either
    std::map<Modality, std::vector<PlannedSample>> training, testing;
};

/// A test photograph and its measured partners. A partner is empty if the fabric has no such sample left.
struct TestPair {
    std::size_t fabric = 0;  ///< index in TestPlan::fabrics
    PlannedSample photograph;
    std::optional<PlannedSample> press, stroke;
    std::optional<PlannedSample> otherPress, otherStroke;  ///< other files of the same fabric
};

/// Numbers of test samples, by signal.
struct Leaks {
    std::map<Modality, int> tested;          ///< in the testing part, before samples are left out
    std::map<Modality, int> trainedOn;       ///< left out because a model was trained on this file
    std::map<Modality, int> placeTrainedOn;  ///< left out by location because a training sample overlaps it
    std::map<Modality, int> duplicates;      ///< identical with a file outside the testing part
    std::map<Modality, int> overlaps;        ///< overlap a sample outside the testing part
    bool placesKnown = true;                 ///< false: overlaps could not be searched for all samples
};

struct TestPlan {
    std::vector<PlannedFabric> fabrics;  ///< all fabrics in the order of the data set
    std::vector<TestPair> pairs;         ///< in the order of fabrics, then photographs
    Leaks leaks;
    std::vector<std::string> notes;
};

struct PlanRequest {
    SplitKind split = SplitKind::Sample;
    std::uint64_t seed = 1;
    std::set<std::string> trainedOn;           ///< SHA-256 of every file that a model was trained on
    std::vector<protocols::FabricId> heldOut;  ///< test fabrics of the split by fabric
    std::optional<int> samplesPerFabric;       ///< number of test photographs; none: all
    unsigned threads = 0;                      ///< 0: as many as the machine has; the results do not depend on it
};

/// Plans the evaluation. Throws badInput if the data set has no photographs or if no test photograph is left.
TestPlan testPlan(const rendering::fabrics::Dataset& dataset, const PlanRequest& request, const Report& report = {});

}  // namespace study::evaluation
