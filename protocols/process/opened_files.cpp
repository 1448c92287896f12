#include "protocols/process/opened_files.h"

#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <system_error>

namespace protocols {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostFolders = 4096;

/// The folders below `place`, and itself.
std::vector<fs::path> foldersFrom(const fs::path& place, bool& isComplete)
{
    std::vector<fs::path> folders{place};
    std::error_code problem;
    for (fs::recursive_directory_iterator at(place, problem), end; !problem && at != end; at.increment(problem)) {
        std::error_code none;
        if (at->is_symlink(none) || !at->is_directory(none)) continue;
        folders.push_back(at->path());
        if (folders.size() == mostFolders) {
            isComplete = false;
            break;
        }
    }
    return folders;
}

}  // namespace

OpenedFiles::OpenedFiles(const std::vector<fs::path>& places) : m_queue(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC))
{
    if (m_queue < 0) {
        m_isComplete = false;
        return;
    }
    std::error_code none;
    for (const fs::path& place : places)
        if (fs::is_directory(place, none))
            for (const fs::path& folder : foldersFrom(place, m_isComplete)) watch(folder);
        else if (fs::is_regular_file(place, none))
            watch(place);
}

OpenedFiles::~OpenedFiles()
{
    if (m_queue >= 0) ::close(m_queue);
}

void OpenedFiles::watch(const fs::path& place)
{
    const int number = ::inotify_add_watch(m_queue, place.c_str(), IN_CLOSE_NOWRITE);
    if (number < 0)
        m_isComplete = false;
    else
        m_places.emplace(number, place);
}

const std::map<fs::path, int>& OpenedFiles::counts()
{
    alignas(inotify_event) std::array<char, std::size_t{1} << 16> buffer;
    while (m_queue >= 0) {
        const ssize_t length = ::read(m_queue, buffer.data(), buffer.size());
        if (length <= 0) break;
        for (std::size_t at = 0; at < static_cast<std::size_t>(length);) {
            inotify_event event{};
            std::memcpy(&event, buffer.data() + at, sizeof event);
            const char* name = buffer.data() + at + sizeof event;
            at += sizeof event + event.len;
            if ((event.mask & IN_Q_OVERFLOW) != 0) m_isComplete = false;
            const auto place = m_places.find(event.wd);
            if ((event.mask & IN_ISDIR) != 0 || place == m_places.end()) continue;
            ++m_counts[event.len > 0 ? place->second / name : place->second];
        }
    }
    return m_counts;
}

}  // namespace protocols
