#include "database/disk/write_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "protocols/files/errors.h"
#include "protocols/files/open_files.h"

namespace database {

namespace {

/// The number of the process that holds the lock, from the lock file; empty if it cannot be read.
std::string holderOf(int descriptor)
{
    std::array<char, 32> text{};
    const ssize_t length = ::pread(descriptor, text.data(), text.size(), 0);
    std::string digits;
    for (ssize_t i = 0; i < length && text[i] >= '0' && text[i] <= '9'; ++i) digits += text[i];
    return digits;
}

protocols::Error heldByAnother(const StudyFolder& folder, int descriptor)
{
    const std::string holder = holderOf(descriptor);
    return protocols::environmentFault(
        {"another program has the study open for writing" + (holder.empty() ? std::string() : " (process " + holder + ")"),
         folder.folder.string(), "one writer at a time", "close the study there first"});
}

}  // namespace

WriteLock::WriteLock(const StudyFolder& folder)
{
    m_descriptor = ::open(folder.lock().c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
    if (m_descriptor < 0 && protocols::isTooManyOpenFiles(errno)) throw protocols::tooManyOpenFiles(folder.lock().string());
    struct stat status {};
    if (m_descriptor < 0 ? errno == ELOOP : (::fstat(m_descriptor, &status) != 0 || !S_ISREG(status.st_mode))) {
        if (m_descriptor >= 0) ::close(m_descriptor);
        throw protocols::badInput({"a link or something else stands in the place of the file", folder.lock().string(),
                                   "the lock of the study, or no file of this name", "remove it; nothing was written"});
    }
    if (m_descriptor < 0)
        throw protocols::environmentFault({std::string("the study cannot be opened for writing: ") + std::strerror(errno),
                                           folder.folder.string(), "a folder that may be written",
                                           "check its permissions and its file system"});
    if (::flock(m_descriptor, LOCK_EX | LOCK_NB) != 0) {
        const int reason = errno;
        const protocols::Error held = heldByAnother(folder, m_descriptor);
        ::close(m_descriptor);
        if (reason == EWOULDBLOCK) throw held;
        throw protocols::environmentFault({std::string("the file system cannot lock a file: ") + std::strerror(reason),
                                           folder.lock().string(), "a file system with file locks", "use a local disk"});
    }
    // The number is only for the message to a second writer. The open file is the lock.
    const std::string process = std::to_string(::getpid()) + "\n";
    if (::ftruncate(m_descriptor, 0) == 0) {
        [[maybe_unused]] const ssize_t written = ::pwrite(m_descriptor, process.data(), process.size(), 0);
    }
}

WriteLock::~WriteLock() { ::close(m_descriptor); }

}  // namespace database
