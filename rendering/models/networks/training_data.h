// What the networks learn from: the training and validation parts of a data set, read once into
// memory at one pitch. The testing part is never read. Drawing from them is batches.h.
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "rendering/fabrics/dataset.h"
#include "rendering/models/architecture.h"
#include "rendering/models/networks/friction_target.h"

namespace rendering::models {

struct TrainingPhotograph {
    int index = 0;
    cv::Mat rgb;             ///< CV_8UC3 at Architecture::mmPerPixel
    double rotationDeg = 0;  ///< of the fabric in the picture, anticlockwise; 0 where unknown
};

struct TrainingHeight {
    int index = 0;
    cv::Mat heightMm;  ///< CV_32FC1, >= 0, at Architecture::mmPerPixel
    double rotationDeg = 0;
    std::vector<float> rings;  ///< ringPowers() of the map as pressed
};

struct TrainingStroke {
    int index = 0;
    FrictionTarget target;
};

struct FabricSamples {
    protocols::FabricId fabric;
    std::vector<TrainingPhotograph> photographs;
    std::vector<TrainingHeight> heights;
    std::vector<TrainingStroke> strokes;
    bool complete() const { return !photographs.empty() && !heights.empty() && !strokes.empty(); }
};

struct TrainingData {
    Architecture architecture;  ///< pitch, spectrogram and scales as the data set has them
    bool aligned = false;
    double heightRangeMm = 1;                         ///< highest less lowest of the training maps
    std::vector<FabricSamples> training, validation;  ///< fabrics that have all three signals
    std::vector<std::string> trainingHashes;          ///< SHA-256 of every file trained on, sorted
    std::vector<std::string> notes;                   ///< what was left out and why, a line each
};

/// By which units a data set is divided 8:1:1.
enum class SplitBy {
    Sample,    ///< the paper's: places may overlap across the parts
    Location,  ///< overlapping places stay together
    Augmented  ///< the paper's after augmentation: every original has copies in every part, so nothing is unseen
};
std::string nameOf(SplitBy split);

struct TrainingDataOptions {
    std::uint64_t splitSeed = 1;
    SplitBy split = SplitBy::Location;
    std::vector<protocols::FabricId> heldOut;        ///< fabrics that training never sees
    std::size_t memoryBytes = std::size_t{3} << 30;  ///< budget of the cached samples
};

/// Throws badInput naming the signal that the data set lacks, or where nothing is left to train on.
TrainingData readTrainingData(const fabrics::Dataset& dataset, const Architecture& wanted, const TrainingDataOptions& options,
                              const std::function<void(int, int)>& progress = {});

}  // namespace rendering::models
