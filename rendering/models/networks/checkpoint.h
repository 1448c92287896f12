// State of a training run on disk: networks, optimisers and elapsed time. It is written whole at regular steps, so that
// an interrupted run continues with the same result. Only the torch sources of this folder include it.
#pragma once

#include <torch/torch.h>

#include <filesystem>
#include <functional>
#include <string>

namespace rendering::models {

struct Checkpoint {
    std::string fingerprint;                ///< identifies the data set and the settings of the run
    std::string validationBefore = "null";  ///< JSON: figures of the untrained networks
    int step = 0, bestStep = 0;
    double bestDistance = 1e300;  ///< smallest of all validations
    int validationsWithoutBetter = 0;
    double elapsedS = 0;  ///< time of optimisation over all parts of the run
};

std::filesystem::path checkpointOf(const std::filesystem::path& model);

/// Writes a checkpoint; `save` adds the networks and optimisers. Throws environmentFault.
void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint,
                     const std::function<void(torch::serialize::OutputArchive&)>& save);

/// Throws badInput where the file is missing or damaged, or belongs to another run.
Checkpoint readCheckpoint(const std::filesystem::path& file, const std::string& fingerprint,
                          const std::function<void(torch::serialize::InputArchive&)>& load);

}  // namespace rendering::models
