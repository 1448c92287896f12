// Training the pair of generators against the one discriminator (paper, equations 1 to 3), with
// checkpoints that a broken-off run resumes from bit for bit. No torch in this header.
#pragma once

#include "rendering/fabrics/dataset.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace rendering::models {

struct TrainingOptions {
    std::filesystem::path out;                ///< the weights; the model card is written beside them
    std::optional<int> steps;                 ///< exactly one of steps and minutes
    std::optional<double> minutes;            ///< wall time of the optimisation
    std::uint64_t seed = 1;
    std::uint64_t splitSeed = 1;
    std::vector<protocols::FabricId> heldOut;
    bool reference = false;                   ///< the paper's losses to the letter
    bool resume = false;
    int batch = 8;
    int crop = 128;                           ///< px, multiple of 16
    int baseChannels = 16;
    double learningRate = 1e-3;               ///< of the generators, falling to a twentieth along a cosine
    int checkpointEvery = 100;                ///< steps
    int validationPairs = 60;
    int threads = 0;                          ///< 0: as many as the machine has
    std::string command;                      ///< as typed, for the model card
};

/// Reports to `log`: a bar with remaining time where `terminal`, plain lines else.
/// Throws badInput (data set, options, a checkpoint of other settings), workFailed where the loss is
/// no longer a number (the last good checkpoint stays), environmentFault where nothing can be written.
void train(const fabrics::Dataset& dataset, const TrainingOptions& options, std::ostream& log, bool terminal);

}  // namespace rendering::models
