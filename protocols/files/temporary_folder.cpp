#include "protocols/files/temporary_folder.h"

#include <fcntl.h>
#include <limits.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "protocols/files/errors.h"

namespace protocols {

namespace {

/// A folder that lives, for the handler of signals, which may use nothing but plain memory.
struct LivingFolder {
    std::atomic<pid_t> owner = 0;  ///< 0: the place is free
    char path[PATH_MAX] = {};
};

constexpr int endingSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE};
constexpr int mostLiving = 32;  // more at one time are not removed at a signal
LivingFolder living[mostLiving];

/// A handler may not walk folders itself: that needs memory of the heap.
void removeByProgram(const char* path)
{
    const pid_t child = ::_Fork();
    if (child == 0) {
        ::execl("/bin/rm", "rm", "-rf", "--", path, static_cast<char*>(nullptr));
        ::_exit(127);
    }
    int status = 0;
    while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
}

/// The copy of a study must not outlive the program. A child that has not yet become another program leaves its parent's folders.
void removeAndEnd(int number)
{
    for (const LivingFolder& folder : living)
        if (folder.owner == ::getpid()) removeByProgram(folder.path);
    std::signal(number, SIG_DFL);
    (void)::raise(number);
}

/// Signals that the program ignores, or handles in another way, stay as they are.
void handleEndingSignals()
{
    for (const int number : endingSignals) {
        struct sigaction present {};
        if (::sigaction(number, nullptr, &present) != 0 || (present.sa_flags & SA_SIGINFO) != 0) continue;
        if (present.sa_handler == SIG_DFL) std::signal(number, removeAndEnd);
    }
}

void enter(const std::string& path)
{
    if (path.size() >= sizeof(LivingFolder::path)) return;
    handleEndingSignals();
    for (LivingFolder& folder : living) {
        pid_t none = 0;
        constexpr pid_t beingWritten = -1;
        if (!folder.owner.compare_exchange_strong(none, beingWritten)) continue;
        path.copy(folder.path, path.size());
        folder.path[path.size()] = '\0';
        folder.owner = ::getpid();
        return;
    }
}

void leave(const std::string& path)
{
    for (LivingFolder& folder : living)
        if (folder.owner == ::getpid() && path == folder.path) folder.owner = 0;
}

}  // namespace

std::vector<std::filesystem::path> temporaryPlaces()
{
    std::error_code none;
    const std::filesystem::path usual = "/tmp",
                                present = std::filesystem::canonical(std::filesystem::temp_directory_path(none), none);
    if (none || present == usual) return {usual};
    return {present, usual};
}

void removeLivingFolders()
{
    for (LivingFolder& folder : living) {
        pid_t owner = ::getpid();
        constexpr pid_t beingRemoved = -1;  // a thread that goes on can neither free nor take the place
        if (!folder.owner.compare_exchange_strong(owner, beingRemoved)) continue;
        std::error_code ignored;
        std::filesystem::remove_all(folder.path, ignored);
        folder.owner = 0;
    }
}

TemporaryFolder::TemporaryFolder()
{
    const std::filesystem::path parent = temporaryPlaces().front();
    std::string name = (parent / "vis2hap-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw environmentFault({std::string("a temporary folder cannot be created: ") + std::strerror(errno), parent.string(),
                                "a writable folder with free space", "free space or set TMPDIR"});
    m_path = name;
    enter(m_path);
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
    leave(m_path);
}

NamelessFile::NamelessFile(const std::filesystem::path& folder)
    : m_descriptor(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600))
{
    if (m_descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return;
    // Sticks and network shares have no files without a name.
    const std::string end = "-" + std::to_string(::getpid());
    std::string name = (folder / ".study.db.unfinished-XXXXXX").string() + end;
    m_descriptor = ::mkostemps(name.data(), static_cast<int>(end.size()), O_CLOEXEC);
    if (m_descriptor >= 0 && ::unlink(name.c_str()) != 0) m_name = name;  // some shares keep it until it is closed
}

NamelessFile::~NamelessFile()
{
    if (m_descriptor >= 0) ::close(m_descriptor);
    if (!m_name.empty()) ::unlink(m_name.c_str());
}

bool keepsAccessRights(const std::filesystem::path& folder)
{
    const NamelessFile file(folder);
    struct stat status {};
    return file.descriptor() < 0 || ::fstat(file.descriptor(), &status) != 0 || (status.st_mode & 077U) == 0;
}

int reasonAgainstRoom(const std::filesystem::path& folder, std::uintmax_t bytes)
{
    const NamelessFile file(folder);
    if (file.descriptor() < 0) return errno == EDQUOT || errno == ENOSPC ? errno : 0;
    int reason = ::posix_fallocate(file.descriptor(), 0, static_cast<off_t>(bytes));
    // A network share reports a refusal only when the bytes are sent to it.
    if (reason == 0 && ::fsync(file.descriptor()) != 0) reason = errno;
    return reason == ENOSPC || reason == EDQUOT || reason == EFBIG ? reason : 0;
}

}  // namespace protocols
