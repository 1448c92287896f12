// Every fault of a data set, each with its file: `vis2hap fabrics check`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rendering::fabrics {

/// Lines "file: fault"; empty for a sound data set. A folder that is no data set at all throws badInput.
/// `progress(done, total)` counts samples; what it throws stops the check.
std::vector<std::string> faultsOfDataset(const std::filesystem::path& folder, const std::function<void(int, int)>& progress = {});

}  // namespace rendering::fabrics
