// Training of the networks that see, on drawn fabrics without end and on scanned cloth. Checkpoints let an interrupted run
// continue bit for bit. No torch in this header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "rendering/fabrics/dataset.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/seeing/training_place.h"

namespace rendering::models {

class ClothObjective;

struct ClothTrainingOptions {
    std::filesystem::path out;                 ///< weights file; the model card is written beside it
    std::filesystem::path from;                ///< model of such a training to start from, with its sizes; empty: new weights
    std::filesystem::path towards;             ///< without training: weights on the way from `from` to this model
    double way = 0.5;                          ///< share of that way, 0 to 1
    std::optional<int> steps;                  ///< exactly one of steps and minutes is set
    std::optional<double> minutes;             ///< wall time of the optimisation
    std::uint64_t seed = 1;                    ///< of the first weights and of the drawn fabrics
    std::vector<protocols::FabricId> heldOut;  ///< scans that are left out; of a lab's own cloth, the fabrics that are held out
    std::uint64_t splitSeed = 1;               ///< of the places and fabrics of a lab that are held out
    bool resume = false;
    int batch = 8;
    int side = 128;              ///< px of a patch, multiple of 16
    int baseChannels = 24;       ///< of the relief network
    double scanShare = 0.3;      ///< share of scanned cloth, where there is any
    double learningRate = 2e-3;  ///< falls to a fiftieth along a cosine
    int checkpointEvery = 500;   ///< steps
    int validateEvery = 1000;    ///< steps
    int validationPatches = 96;
    int threads = 0;      ///< 0: all threads of the machine
    TrainingPlace place;  ///< `batch` is that of all processes together
    /// Makes the losses of a control (cloth_steps.h); empty: our losses. Controls see drawn fabrics only, in one process.
    std::function<std::unique_ptr<ClothObjective>(const Architecture&)> makeObjective = {};
    std::string command;  ///< as typed, for the model card
};

/// Trains and writes the moving average of the networks. With `towards` it trains nothing: a training on other cloth costs part
/// of what the model knew, and weights between both keep most of the two (Wortsman et al., "Robust fine-tuning", 2022). `scans`:
/// a data set of `vis2hap import scans`, or nullptr. Reports to `log`; a start from a model prints its figures before and after.
/// In several processes, all are called with the same options but for the rank; only rank 0 reads a checkpoint and writes.
/// Throws badInput (options, data set, model, a checkpoint of other settings, processes that differ), environmentFault where
/// nothing can be written, workFailed where the loss stops being finite or another process ends; the last good checkpoint stays.
void trainOnCloth(const fabrics::Dataset* scans, const ClothTrainingOptions& options, std::ostream& log, bool terminal);

/// Throws badInput for options that no training can follow.
void requireUsable(const ClothTrainingOptions& options);

/// Sets the threads of the computation; one of the options' threads draws the next batch.
void setTrainingThreads(const ClothTrainingOptions& options);

/// Adds the SHA-256 of files of the training to a card, whose list stays sorted and has each once.
void addTrainingHashes(ModelCardFields& card, const std::vector<std::string>& hashes);

/// Card of a model that training can start from. Throws badInput for a model of other networks.
ModelCardFields cardOfSeeingModel(const std::filesystem::path& model);

}  // namespace rendering::models
