// Files of an import and the fabric of each.
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

/// Rule that finds the name of a fabric.
enum class FabricNaming {
    FolderOrFile,  ///< the sub-folder, else the file name up to its last '_'
    BeforeForce,   ///< the file name up to "_F" and a digit (sliding records)
};

/// Whether no person put the file or folder there. Such files begin with a dot. Network disks and sticks keep older files and
/// thumbnails in folders of their own, such as .Trash-1000, .stversions, .@__thumb, @eaDir and #recycle.
bool isHidden(const std::filesystem::path& entry);

/// The given files, and the files in given folders and their sub-folders that have one of `endings` (lower case, with the
/// dot). Hidden files and folders in them are left out. Ordered by fabric name and path. Throws badInput for a missing path and
/// for a folder without such a file.
std::vector<SourceFile> sourceFiles(std::span<const std::filesystem::path> from, std::span<const std::string_view> endings,
                                    FabricNaming naming);

/// A line about pictures of other formats in the folders (HEIC, WebP, raw files of cameras), which sourceFiles() leaves out;
/// empty if there are none.
std::string picturesLeftOut(std::span<const std::filesystem::path> from, std::span<const std::string_view> endings);

std::string lowerCase(std::string text);

}  // namespace rendering::fabrics
