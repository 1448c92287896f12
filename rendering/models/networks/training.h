// Training of both generators against the discriminator (paper, equations 1 to 3). Checkpoints let an interrupted run
// continue bit for bit. No torch in this header.
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

/// Loss function of a training (losses.h).
enum class Objective {
    Default,    ///< ours
    Reference,  ///< exactly the paper's equations (1) to (3)
    L1Only      ///< the paper's equation (3) alone: the control "U-Net by L1"
};
/// "default", "reference" or "l1-only", as in the model card.
std::string nameOf(Objective objective);

/// Margin around the crop in which the measured map is registered; more than half a repeat of a fabric of 3.5 mm.
inline constexpr int registrationMarginPx = 36;

struct TrainingOptions {
    std::filesystem::path out;      ///< weights file; the model card is written beside it
    std::optional<int> steps;       ///< exactly one of steps and minutes is set
    std::optional<double> minutes;  ///< wall time of the optimisation
    std::optional<int> stopAt;      ///< step after which training ends, though the learning rate falls over all of `steps`
    std::uint64_t seed = 1;
    std::uint64_t splitSeed = 1;
    SplitBy split = SplitBy::Location;
    std::vector<protocols::FabricId> heldOut;
    Objective objective = Objective::Default;
    bool resume = false;
    int batch = 8;
    int crop = 128;  ///< px, multiple of 16
    int baseChannels = 16;
    double learningRate = 1e-3;  ///< rate for the generators; it falls to a fiftieth along a cosine
    int checkpointEvery = 100;   ///< steps
    int validateEvery = 250;     ///< steps
    int patience = 12;           ///< number of validations without a better one after which training stops
    int validationPairs = 60;
    int threads = 0;      ///< 0: all threads of the machine
    std::string command;  ///< as typed, for the model card
};

/// Trains and writes the networks of the best validation; with the reference's losses, those of the last step. Reports to
/// `log`: a bar with the remaining time where `terminal`, else plain lines. Throws badInput (data set, options, a
/// checkpoint of other settings) and environmentFault where nothing can be written. Throws workFailed where the loss stops
/// being finite; the last good checkpoint stays.
void train(const fabrics::Dataset& dataset, const TrainingOptions& options, std::ostream& log, bool terminal);

}  // namespace rendering::models
