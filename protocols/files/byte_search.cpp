#include "protocols/files/byte_search.h"

#include <algorithm>

#include "protocols/files/whole_file.h"

namespace protocols {

namespace {

constexpr std::size_t keyBytes = 3;

std::size_t keyOf(const char* bytes)
{
    std::size_t key = 0;
    for (std::size_t i = 0; i < keyBytes; ++i) key = key << 8 | static_cast<unsigned char>(bytes[i]);
    return key;
}

bool holds(const std::filesystem::path& file, const ByteSequences& sequences)
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

ByteSequences::ByteSequences(const std::vector<std::string>& all) : m_starts(std::size_t{1} << (8 * keyBytes), false)
{
    for (const std::string& one : all) {
        if (one.size() < keyBytes) continue;
        m_longest = std::max(m_longest, std::min(one.size(), comparedBytes));
        m_starts[keyOf(one.data())] = true;
        m_byKey[keyOf(one.data())].push_back(one);
    }
}

void ByteSequences::findIn(std::string_view bytes, const std::function<bool(const std::string&)>& found) const
{
    for (std::size_t at = 0; at + keyBytes <= bytes.size(); ++at) {
        const std::size_t key = keyOf(bytes.data() + at);
        if (!m_starts[key]) continue;
        for (const std::string& one : m_byKey.at(key))
            if (bytes.substr(at).starts_with(std::string_view(one).substr(0, comparedBytes)) && !found(one)) return;
    }
}

bool ByteSequences::areIn(std::string_view bytes) const
{
    bool isFound = false;
    findIn(bytes, [&](const std::string&) { return !(isFound = true); });
    return isFound;
}

ByteSearch searchFiles(const std::filesystem::path& folder, const std::vector<std::string>& sequences,
                       const std::vector<std::filesystem::path>& others,
                       const std::function<bool(const std::string& name)>& isLeftOut)
{
    ByteSearch search;
    const ByteSequences wanted(sequences);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file() || entry.is_symlink()) continue;
        const std::string name = entry.path().lexically_relative(folder).string();
        if (isLeftOut && isLeftOut(name)) continue;
        ++search.files;
        if (holds(entry.path(), wanted)) search.found.push_back(name);
    }
    for (const auto& file : others) {
        ++search.files;
        if (holds(file, wanted)) search.found.push_back(file.string());
    }
    std::ranges::sort(search.found);
    return search;
}

}  // namespace protocols
