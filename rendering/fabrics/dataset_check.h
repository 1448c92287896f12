// The check of a data set that `vis2hap fabrics check` runs: every fault with its file, and notes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rendering::fabrics {

struct DatasetFindings {
    std::vector<std::string> faults;  ///< lines "file: fault"; empty for a sound data set
    std::vector<std::string> notes;   ///< what the program can work with, but a person may not expect
};

/// Throws badInput where the folder is not a data set. `progress(done, total)` counts samples; an exception that it throws ends
/// the check.
DatasetFindings findingsOfDataset(const std::filesystem::path& folder, const std::function<void(int, int)>& progress = {});

/// The faults alone.
std::vector<std::string> faultsOfDataset(const std::filesystem::path& folder, const std::function<void(int, int)>& progress = {});

}  // namespace rendering::fabrics
