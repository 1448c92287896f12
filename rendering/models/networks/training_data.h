// Training data: the training and validation parts of a data set, read once into memory at one pitch. The test part is
// never read. batches.h draws from them.
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "rendering/fabrics/dataset.h"
#include "rendering/models/architecture.h"
#include "rendering/models/seeing/friction_target.h"

namespace rendering::models {

struct TrainingPhotograph {
    int index = 0;
    cv::Mat rgb;             ///< CV_8UC3 at Architecture::mmPerPixel
    double rotationDeg = 0;  ///< rotation of the fabric in the picture, anticlockwise; 0 where unknown
};

struct TrainingHeight {
    int index = 0;
    cv::Mat heightMm;  ///< CV_32FC1, >= 0, at Architecture::mmPerPixel
    double rotationDeg = 0;
    std::vector<float> rings;  ///< ringPowers() of the map before rotation
};

struct TrainingStroke {
    int index = 0;
    FrictionTarget target;
};

struct TrainingFabric {
    protocols::FabricId fabric;
    std::vector<TrainingPhotograph> photographs;
    std::vector<TrainingHeight> heights;
    std::vector<TrainingStroke> strokes;
    bool complete() const { return !photographs.empty() && !heights.empty() && !strokes.empty(); }
};

struct TrainingData {
    Architecture architecture;  ///< with the pitch, spectrogram and scales of the data set
    bool aligned = false;
    double heightRangeMm = 1;                          ///< highest minus lowest value of the training maps
    std::vector<TrainingFabric> training, validation;  ///< fabrics that have all three signals
    std::vector<std::string> trainingHashes;           ///< SHA-256 of every training file, sorted
    std::vector<std::string> notes;                    ///< samples that were left out and the reason, one line each
};

/// Units of the 8:1:1 split.
enum class SplitBy {
    Sample,    ///< samples, as in the paper; places may overlap between parts
    Location,  ///< groups of overlapping places
    Augmented  ///< the paper's split after augmentation: every part has copies of every original, so none is unseen
};
std::string nameOf(SplitBy split);

struct TrainingDataOptions {
    std::uint64_t splitSeed = 1;
    SplitBy split = SplitBy::Location;
    std::vector<protocols::FabricId> heldOut;        ///< fabrics that are excluded from training and validation
    std::size_t memoryBytes = std::size_t{3} << 30;  ///< budget of the cached samples
};

/// Throws badInput that names the missing signal, or where no fabric remains for training.
TrainingData readTrainingData(const fabrics::Dataset& dataset, const Architecture& wanted, const TrainingDataOptions& options,
                              const std::function<void(int, int)>& progress = {});

}  // namespace rendering::models
