// Every fault of a data set, each with its file: `vis2hap fabrics check`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rendering::fabrics {

/// Lines "file: fault"; empty for a sound data set. A folder that is no data set at all throws badInput.
std::vector<std::string> faultsOfDataset(const std::filesystem::path& folder);

}  // namespace rendering::fabrics
