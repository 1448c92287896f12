// Looks for byte sequences in every file of a folder, as a proof that something is gone.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace protocols {

struct ByteSearch {
    std::size_t files = 0;           ///< regular files that were read, in all sub-folders
    std::vector<std::string> found;  ///< files that hold one of the sequences, relative to the folder; others as given
};

/// Compares the first 24 bytes of each sequence, because a database may split a longer one over two pages. Links are not
/// followed. `others`: files elsewhere that are searched, too. Throws badInput where a file cannot be read.
ByteSearch searchFiles(const std::filesystem::path& folder, const std::vector<std::string>& sequences,
                       const std::vector<std::filesystem::path>& others = {});

}  // namespace protocols
