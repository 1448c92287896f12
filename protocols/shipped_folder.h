// Where the files that belong to the program lie: weights, scripts. Nothing of a study is among them.
#pragma once

#include <filesystem>
#include <string>

namespace protocols {

/// The folder `name` of the running program: beside it, or in share/vis2hap of the prefix into which it was installed, or in its
/// sources. The last one is returned where none exists, so that a fault names it.
inline std::filesystem::path shippedFolder(const std::string& name, const std::filesystem::path& inSources)
{
    std::error_code none;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
    for (const auto& folder : {program / name, program.parent_path() / "share" / "vis2hap" / name})
        if (!program.empty() && std::filesystem::is_directory(folder, none)) return folder;
    return inSources;
}

}  // namespace protocols
