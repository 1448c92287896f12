// Summary of a weights file, and the path of the weights that come with the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace rendering::models {

/// Summary of a weights file, from the .json file beside it; read without libtorch.
struct ModelCard {
    std::string name;
    std::string sha256;  ///< hash of the weights file
    bool trainedOnProceduralSet = false;
    std::vector<std::string> trainingSampleHashes;  ///< SHA-256 of every training file, sorted
    /// Seeds by which this training and those before it drew fabrics themselves. Cards of 0.6.0 and before know only their own.
    std::set<std::uint64_t> drawnSeeds;
    std::string trainingCommand;
};
ModelCard readModelCard(const std::filesystem::path& model);

/// Weights that come with the program: beside the executable in an installed tree, else in the source tree.
std::filesystem::path shippedModel();
/// Weights of version 0.5.0, for comparisons of speed. An installed tree may lack them.
std::filesystem::path earlierModel();

}  // namespace rendering::models
