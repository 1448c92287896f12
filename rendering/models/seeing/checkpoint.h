// State of a training run on disk: networks, optimisers and elapsed time. It is written whole at regular steps, so that
// an interrupted run continues with the same result. The file holds plain tensors
// (tensor_file.h) and the fields of Checkpoint as JSON in its metadata.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rendering/models/tensors/tensor_file.h"

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

/// Writes the run with the tensors of networks and optimisers. Throws environmentFault.
void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint, const std::vector<StoredTensor>& tensors);

/// A checkpoint with its tensors in the order of `wanted`.
struct StoredRun {
    Checkpoint state;
    std::vector<StoredTensor> tensors;
};

/// Throws badInput where the file is missing or damaged, holds other tensors than `wanted`, or belongs to another run.
StoredRun readCheckpoint(const std::filesystem::path& file, const std::string& fingerprint,
                         const std::vector<TensorKind>& wanted);

}  // namespace rendering::models
