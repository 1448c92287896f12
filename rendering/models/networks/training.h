// Training the pair of generators against the one discriminator (paper, equations 1 to 3), with
// checkpoints that a broken-off run resumes from bit for bit. No torch in this header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "rendering/fabrics/dataset.h"
#include "rendering/models/networks/training_data.h"

namespace rendering::models {

/// What a training minimises (losses.h).
enum class Objective {
    Default,    ///< ours
    Reference,  ///< the paper's equations (1) to (3) to the letter
    L1Only      ///< the paper's equation (3) alone: the control "U-Net by L1"
};
/// "default", "reference", "l1-only": as the model card has them.
std::string nameOf(Objective objective);

/// How far beyond the crop, each way, the measured map that fits best is looked for; more than half a
/// repeat of a fabric of 3.5 mm.
inline constexpr int registrationMarginPx = 36;

struct TrainingOptions {
    std::filesystem::path out;      ///< the weights; the model card is written beside them
    std::optional<int> steps;       ///< exactly one of steps and minutes
    std::optional<double> minutes;  ///< wall time of the optimisation
    std::uint64_t seed = 1;
    std::uint64_t splitSeed = 1;
    SplitBy split = SplitBy::Location;
    std::vector<protocols::FabricId> heldOut;
    Objective objective = Objective::Default;
    bool resume = false;
    int batch = 8;
    int crop = 128;  ///< px, multiple of 16
    int baseChannels = 16;
    double learningRate = 1e-3;  ///< of the generators, falling to a fiftieth along a cosine
    int checkpointEvery = 100;   ///< steps
    int validateEvery = 250;     ///< steps
    int patience = 12;           ///< validations without a better one, after which training stops
    int validationPairs = 60;
    int threads = 0;      ///< 0: as many as the machine has
    std::string command;  ///< as typed, for the model card
};

/// MODEL.log: the folder with the curves and sample pictures of a training (training_log.h).
std::filesystem::path logOf(const std::filesystem::path& model);

/// The result is the networks as they were at the best validation, for the reference's losses at the end.
/// Reports to `log`: a bar with remaining time where `terminal`, plain lines else.
/// Throws badInput (data set, options, a checkpoint of other settings), workFailed where the loss is
/// no longer a number (the last good checkpoint stays), environmentFault where nothing can be written.
void train(const fabrics::Dataset& dataset, const TrainingOptions& options, std::ostream& log, bool terminal);

}  // namespace rendering::models
