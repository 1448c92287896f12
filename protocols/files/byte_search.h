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

inline constexpr std::size_t comparedBytes = 24;  ///< of a sequence; a database may split a longer one over two pages

/// Byte sequences to look for, of which the first comparedBytes count. Shorter ones than 3 bytes are left out.
class ByteSequences {
public:
    explicit ByteSequences(const std::vector<std::string>& all);

    /// Calls `found` with each sequence that stands in the bytes, once for each place, until it returns false.
    void findIn(std::string_view bytes, const std::function<bool(const std::string& sequence)>& found) const;
    bool areIn(std::string_view bytes) const;
    std::size_t longest() const { return m_longest; }  ///< bytes of the longest part that is compared

private:
    std::vector<bool> m_starts;  ///< by the first bytes as a number
    std::map<std::size_t, std::vector<std::string>> m_byKey;
    std::size_t m_longest = 0;
};

struct ByteSearch {
    std::size_t files = 0;            ///< regular files that were read, in all sub-folders
    std::vector<std::string> found;   ///< files that hold one of the sequences, relative to the folder; others as given
    std::vector<std::string> unread;  ///< files and folders that could not be read, named in the same way
};

/// Regular files in the folder and its sub-folders, as far as it can be listed; links are not followed.
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder);

/// A file or folder that this account cannot read, or the folder itself.
struct Unreadable {
    std::filesystem::path path;
    std::string reason;
};
/// What searchFiles() could not read in the folder, without opening a file.
std::vector<Unreadable> unreadableIn(const std::filesystem::path& folder);

/// Compares the first comparedBytes of each sequence. Links are not followed. `others`: files elsewhere that are searched, too.
/// `isLeftOut`: files in the folder, by their relative names, that are not opened. A file that vanishes
/// meanwhile does not count.
ByteSearch searchFiles(const std::filesystem::path& folder, const std::vector<std::string>& sequences,
                       const std::vector<std::filesystem::path>& others = {},
                       const std::function<bool(const std::string& name)>& isLeftOut = {});

}  // namespace protocols
