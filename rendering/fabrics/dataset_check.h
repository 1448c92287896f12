// The check of a data set that `vis2hap fabrics check` runs: every fault with its file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rendering::fabrics {

/// Lines "file: fault"; empty for a sound data set. Throws badInput where the folder is not a data set.
/// `progress(done, total)` counts samples; an exception that it throws ends the check.
std::vector<std::string> faultsOfDataset(const std::filesystem::path& folder, const std::function<void(int, int)>& progress = {});

}  // namespace rendering::fabrics
