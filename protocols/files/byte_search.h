// Looks for byte sequences in every file of a folder, as a proof that something is gone.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace protocols {

/// Byte sequences to look for, of which the first 24 bytes count. Shorter ones than 3 bytes are left out.
class ByteSequences {
public:
    explicit ByteSequences(const std::vector<std::string>& all);

    /// Calls `found` with each sequence that stands in the bytes, once for each place, until it returns false.
    void findIn(std::string_view bytes, const std::function<bool(const std::string& sequence)>& found) const;
    bool areIn(std::string_view bytes) const;
    std::size_t longest() const { return m_longest; }  ///< of the compared parts, in bytes

private:
    std::vector<bool> m_starts;  ///< by the first bytes as a number
    std::map<std::size_t, std::vector<std::string>> m_byKey;
    std::size_t m_longest = 0;
};

struct ByteSearch {
    std::size_t files = 0;           ///< regular files that were read, in all sub-folders
    std::vector<std::string> found;  ///< files that hold one of the sequences, relative to the folder; others as given
};

/// Compares the first 24 bytes of each sequence, because a database may split a longer one over two pages. Links are not
/// followed. `others`: files elsewhere that are searched, too. Throws badInput where a file cannot be read.
ByteSearch searchFiles(const std::filesystem::path& folder, const std::vector<std::string>& sequences,
                       const std::vector<std::filesystem::path>& others = {});

}  // namespace protocols
