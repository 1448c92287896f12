// Which files an import takes and which fabric each belongs to.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rendering::fabrics {

struct SourceFile {
    std::filesystem::path file;
    std::string fabricName;
};

/// How a fabric's name is read off.
enum class FabricNaming {
    FolderOrFile,  ///< the sub-folder, else the file name up to its last '_'
    BeforeForce,   ///< the file name up to "_F" and a digit (sliding records)
};

/// Files as given; of a folder those with one of `endings` (lower case, with the dot), also in its sub-folders, in
/// order of fabric name and path. Throws badInput for what is missing and for a folder without any.
std::vector<SourceFile> sourceFiles(std::span<const std::filesystem::path> from, std::span<const std::string_view> endings,
                                    FabricNaming naming);

std::string lowerCase(std::string text);

}  // namespace rendering::fabrics
