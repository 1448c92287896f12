// What is tested on, what it is compared with, and what the split lets through: which photographs, presses and strokes
// the models never saw, which of them form a pair, and which lie on fabric that was trained on.
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

/// Progress of long work; called on one thread at a time.
using Report = std::function<void(const std::string& stage, int done, int total)>;

/// Augmented: the paper's split after augmentation, in which every original has copies in every part; nothing is left out
/// of the test, and what a model was trained on is counted: such figures measure memory.
enum class SplitKind { Sample, Location, Fabric, Augmented };
std::string_view nameOf(SplitKind kind);  ///< "sample", "location", "fabric", "augmented"

struct Sample {
    protocols::FabricId fabric;
    Modality modality = Modality::Visual;
    int index = 0;
    std::optional<double> rotationDeg;
    std::string sha256;
};

struct FabricSamples {
    protocols::FabricId fabric;
    bool heldOut = false;  ///< from the models: no control may know it
    std::map<Modality, std::vector<Sample>> training, testing;
};

/// What a test photograph is compared with. None: the fabric has no such sample left.
struct TestPair {
    std::size_t fabric = 0;  ///< in TestPlan::fabrics
    Sample photograph;
    std::optional<Sample> press, stroke;
    std::optional<Sample> otherPress, otherStroke;  ///< of the same fabric, another file
};

/// Counts of test samples, by signal.
struct Leaks {
    std::map<Modality, int> tested;          ///< in the testing part, before any is left out
    std::map<Modality, int> trainedOn;       ///< a model was trained on the very file: left out
    std::map<Modality, int> placeTrainedOn;  ///< overlaps a place trained on: left out (by location)
    std::map<Modality, int> duplicates;      ///< same bytes as a file outside the test
    std::map<Modality, int> overlaps;        ///< its place overlaps one outside the test
    bool placesKnown = true;                 ///< else overlaps could not be looked for
};

struct TestPlan {
    std::vector<FabricSamples> fabrics;  ///< every fabric of the data set, in its order
    std::vector<TestPair> pairs;         ///< by fabric, then photograph
    Leaks leaks;
    std::vector<std::string> notes;
};

struct PlanRequest {
    SplitKind split = SplitKind::Sample;
    std::uint64_t seed = 1;
    std::set<std::string> trainedOn;           ///< SHA-256 of every file a model was trained on
    std::vector<protocols::FabricId> heldOut;  ///< by fabric: those tested on
    std::optional<int> samplesPerFabric;       ///< test photographs; none: all
    unsigned threads = 0;                      ///< 0: as many as the machine has; changes no number
};

/// Throws badInput where the data set has no photographs, or nothing is left to test on.
TestPlan testPlan(const rendering::fabrics::Dataset& dataset, const PlanRequest& request, const Report& report = {});

}  // namespace study::evaluation
