// Where a training run stands, on disk: networks, optimisers and clock, written whole every so many
// steps, so that a broken-off run goes on as if nothing had happened.
// Included by this folder's torch sources only.
#pragma once

#include <torch/torch.h>

#include <filesystem>
#include <functional>
#include <string>

namespace rendering::models {

struct Checkpoint {
    std::string fingerprint;                ///< data set and settings of the run
    std::string validationBefore = "null";  ///< JSON: figures of the untrained networks
    int step = 0, bestStep = 0;
    double bestDistance = 1e300;  ///< of the validations so far
    int validationsWithoutBetter = 0;
    double elapsedS = 0;  ///< of optimisation, over all sittings
};

std::filesystem::path checkpointOf(const std::filesystem::path& model);

/// `save` adds the networks and optimisers. Throws environmentFault.
void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint,
                     const std::function<void(torch::serialize::OutputArchive&)>& save);

/// Throws badInput where there is none, it is damaged, or belongs to another run.
Checkpoint readCheckpoint(const std::filesystem::path& file, const std::string& fingerprint,
                          const std::function<void(torch::serialize::InputArchive&)>& load);

}  // namespace rendering::models
