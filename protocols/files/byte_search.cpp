#include "protocols/files/byte_search.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "protocols/files/whole_file.h"

namespace protocols {

namespace {

constexpr std::size_t comparedBytes = 24;
constexpr std::size_t keyBytes = 3;

/// Sequences by their first bytes.
class Sequences {
public:
    explicit Sequences(const std::vector<std::string>& all) : m_starts(std::size_t{1} << (8 * keyBytes), false)
    {
        for (const std::string& one : all) {
            if (one.size() < keyBytes) continue;
            m_longest = std::max(m_longest, std::min(one.size(), comparedBytes));
            m_starts[keyOf(one.data())] = true;
            m_byKey[keyOf(one.data())].push_back(one.substr(0, comparedBytes));
        }
    }

    std::size_t longest() const { return m_longest; }

    bool areIn(std::string_view bytes) const
    {
        for (std::size_t at = 0; at + keyBytes <= bytes.size(); ++at) {
            const std::size_t key = keyOf(bytes.data() + at);
            if (m_starts[key] &&
                std::ranges::any_of(m_byKey.at(key), [&](const std::string& one) { return bytes.substr(at, one.size()) == one; }))
                return true;
        }
        return false;
    }

private:
    static std::size_t keyOf(const char* bytes)
    {
        std::size_t key = 0;
        for (std::size_t i = 0; i < keyBytes; ++i) key = key << 8 | static_cast<unsigned char>(bytes[i]);
        return key;
    }

    std::vector<bool> m_starts;
    std::map<std::size_t, std::vector<std::string>> m_byKey;
    std::size_t m_longest = 0;
};

bool holds(const std::filesystem::path& file, const Sequences& sequences)
{
    bool isFound = false;
    std::string carried;  // the end of the block before, for a sequence that two blocks share
    readInBlocks(file, [&](std::string_view block) {
        if (isFound) return;
        carried.append(block);
        isFound = sequences.areIn(carried);
        const std::size_t kept = std::min(carried.size(), sequences.longest());
        carried.erase(0, carried.size() - kept);
    });
    return isFound;
}

}  // namespace

ByteSearch searchFiles(const std::filesystem::path& folder, const std::vector<std::string>& sequences,
                       const std::vector<std::filesystem::path>& others)
{
    ByteSearch search;
    const Sequences wanted(sequences);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file() || entry.is_symlink()) continue;
        ++search.files;
        if (holds(entry.path(), wanted)) search.found.push_back(entry.path().lexically_relative(folder).string());
    }
    for (const auto& file : others) {
        ++search.files;
        if (holds(file, wanted)) search.found.push_back(file.string());
    }
    std::ranges::sort(search.found);
    return search;
}

}  // namespace protocols
