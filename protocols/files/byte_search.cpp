#include "protocols/files/byte_search.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace protocols {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t keyBytes = 3;

std::size_t keyOf(const char* bytes)
{
    std::size_t key = 0;
    for (std::size_t i = 0; i < keyBytes; ++i) key = key << 8 | static_cast<unsigned char>(bytes[i]);
    return key;
}

/// Regular files in the folder and its sub-folders; links are not followed. `cannotRead`: a folder or an entry, and why.
struct Walk {
    std::function<void(const fs::path&)> file;
    std::function<void(const fs::path&, const std::error_code&)> cannotRead;

    void through(const fs::path& folder) const
    {
        std::error_code problem;
        fs::directory_iterator entries(folder, problem);
        for (const fs::directory_iterator end; !problem && entries != end; entries.increment(problem)) {
            std::error_code unknown;  // of a folder that may be listed and not entered
            const auto kind = entries->symlink_status(unknown).type();
            if (unknown && unknown != std::errc::no_such_file_or_directory) cannotRead(entries->path(), unknown);
            if (kind == fs::file_type::directory) through(entries->path());
            if (kind == fs::file_type::regular) file(entries->path());
        }
        if (problem && problem != std::errc::no_such_file_or_directory) cannotRead(folder, problem);
    }
};

bool holds(const fs::path& file, const ByteSequences& sequences)
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

ByteSearch searchFiles(const fs::path& folder, const std::vector<std::string>& sequences, const std::vector<fs::path>& others,
                       const std::function<bool(const std::string& name)>& isLeftOut)
{
    ByteSearch search;
    const ByteSequences wanted(sequences);
    const auto look = [&](const fs::path& file, const std::string& name) {
        try {
            if (holds(file, wanted)) search.found.push_back(name);
            ++search.files;
        } catch (const Error&) {
            std::error_code unknown;
            if (fs::symlink_status(file, unknown).type() != fs::file_type::not_found) search.unread.push_back(name);
        }
    };
    const auto nameOf = [&](const fs::path& path) { return path.lexically_relative(folder).string(); };
    Walk{[&](const fs::path& file) {
             if (const std::string name = nameOf(file); !isLeftOut || !isLeftOut(name)) look(file, name);
         },
         [&](const fs::path& unread, const std::error_code&) { search.unread.push_back(nameOf(unread)); }}
        .through(folder);
    for (const auto& file : others) look(file, file.string());
    std::ranges::sort(search.found);
    std::ranges::sort(search.unread);
    return search;
}

std::vector<fs::path> filesIn(const fs::path& folder)
{
    std::vector<fs::path> files;
    Walk{[&](const fs::path& file) { files.push_back(file); }, [](const fs::path&, const std::error_code&) {}}.through(folder);
    return files;
}

std::vector<Unreadable> unreadableIn(const fs::path& folder)
{
    std::vector<Unreadable> unreadable;
    const auto add = [&](const fs::path& path, const std::error_code& reason) { unreadable.push_back({path, reason.message()}); };
    Walk{[&](const fs::path& file) {
             // Not opened: closing a file of an open database drops its locks.
             if (::faccessat(AT_FDCWD, file.c_str(), R_OK, AT_EACCESS) != 0 && errno != ENOENT)
                 add(file, std::error_code(errno, std::generic_category()));
         },
         add}
        .through(folder);
    return unreadable;
}

}  // namespace protocols
