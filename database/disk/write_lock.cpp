#include "database/disk/write_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>

#include "protocols/files/errors.h"
#include "protocols/files/open_files.h"
#include "protocols/process/computer_name.h"

namespace database {

namespace {

/// Who wrote the lock file. Empty parts where it does not say: a lock that ended properly, or one of an earlier version.
struct Holder {
    std::string process, computer;
};

constexpr const char* lettersOfNames = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.-_";

/// As the lock file can hold it; empty where it has no name.
std::string nameOfThisComputer()
{
    const std::string name = protocols::computerName();
    return name.substr(0, name.find_first_not_of(lettersOfNames));
}

/// From "4711 name-of-computer".
Holder holderOf(int descriptor)
{
    std::array<char, 320> text{};
    const ssize_t length = ::pread(descriptor, text.data(), text.size(), 0);
    const std::string line(text.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    const auto wordFrom = [&](std::size_t begin, const char* characters) {
        return begin < line.size() ? line.substr(begin, line.find_first_not_of(characters, begin) - begin) : std::string();
    };
    Holder holder;
    holder.process = wordFrom(0, "0123456789");
    if (!holder.process.empty()) holder.computer = wordFrom(holder.process.size() + 1, lettersOfNames);
    return holder;
}

std::string textOf(const Holder& holder)
{
    if (holder.process.empty()) return {};
    return " (process " + holder.process + (holder.computer.empty() ? "" : " on " + holder.computer) + ")";
}

protocols::Error heldByAnother(const StudyFolder& folder, int descriptor)
{
    return protocols::environmentFault({heldByAnotherProgram + textOf(holderOf(descriptor)), folder.folder.string(),
                                        "one writer at a time", "close the study there first"});
}

/// File systems whose locks another computer may not see. (https://man7.org/linux/man-pages/man2/statfs.2.html; vboxsf and vmhgfs
/// are shared folders of virtual machines, BeeGFS and GPFS disks of clusters)
bool isOfOtherComputers(int descriptor)
{
    constexpr std::array<std::uint32_t, 14> kinds{0x65735546 /* FUSE */,   0x517B /* SMB */,
                                                  0xFF534D42 /* CIFS */,   0xFE534D42 /* SMB2 */,
                                                  0x6969 /* NFS */,        0x01021997 /* 9P */,
                                                  0x5346414F /* AFS */,    0x00C36400 /* Ceph */,
                                                  0x73757245 /* Coda */,   0x0BD00BD0 /* Lustre */,
                                                  0x786F4256 /* vboxsf */, 0xBACBACBC /* vmhgfs */,
                                                  0x19830326 /* BeeGFS */, 0x47504653 /* GPFS */};
    struct statfs status {};
    return ::fstatfs(descriptor, &status) == 0 &&
           std::ranges::find(kinds, static_cast<std::uint32_t>(status.f_type)) != kinds.end();
}

/// Throws where the lock was not ended properly by another computer, which may still hold it.
void requireNotHeldElsewhere(const StudyFolder& folder, int descriptor)
{
    const Holder holder = holderOf(descriptor);
    if (holder.computer.empty() || holder.computer == nameOfThisComputer() || !isOfOtherComputers(descriptor)) return;
    throw protocols::environmentFault(
        {"another computer has the study open for writing, or its program ended without closing it" + textOf(holder),
         folder.folder.string(), "one computer at a time on a disk that other computers may use",
         "close the study there; where it is closed for certain, delete " + folder.lock().string() + " and do it again"});
}

}  // namespace

WriteLock::WriteLock(const StudyFolder& folder) : m_folder(folder)
{
    m_descriptor = ::open(folder.lock().c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
    if (m_descriptor < 0 && protocols::isTooManyOpenFiles(errno)) throw protocols::tooManyOpenFiles(folder.lock().string());
    struct stat status {};
    if (m_descriptor < 0 ? errno == ELOOP : (::fstat(m_descriptor, &status) != 0 || !S_ISREG(status.st_mode))) {
        if (m_descriptor >= 0) ::close(m_descriptor);
        throw protocols::badInput({"a link or something else stands in the place of the file", folder.lock().string(),
                                   "the lock of the study, or no file of this name", "remove it; nothing was written"});
    }
    m_device = status.st_dev;
    m_inode = status.st_ino;
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
    try {
        requireNotHeldElsewhere(folder, m_descriptor);
    } catch (...) {
        ::close(m_descriptor);
        throw;
    }
    // The open file is the lock. Its text is for the message to a second writer, and for computers that do not see the lock.
    const std::string process = std::to_string(::getpid()) + " " + nameOfThisComputer() + "\n";
    if (::ftruncate(m_descriptor, 0) == 0) {
        [[maybe_unused]] const ssize_t written = ::pwrite(m_descriptor, process.data(), process.size(), 0);
        if (isOfOtherComputers(m_descriptor)) ::fdatasync(m_descriptor);  // a share may keep it here for half a minute
    }
}

WriteLock::~WriteLock()
{
    [[maybe_unused]] const int emptied = ::ftruncate(m_descriptor, 0);  // says that the lock ended properly
    ::close(m_descriptor);
}

void WriteLock::requireInPlace() const
{
    struct stat named {};
    const bool isThere = ::lstat(m_folder.lock().c_str(), &named) == 0;
    if (isThere ? named.st_dev == m_device && named.st_ino == m_inode : errno != ENOENT) return;
    throw protocols::environmentFault({"the lock of the study was deleted or replaced while it was open",
                                       m_folder.lock().string(), "one writer at a time",
                                       "close the study in every program, then open it again; every stored answer is in it"});
}

void requireNoOtherComputer(const StudyFolder& folder)
{
    const int descriptor = ::open(folder.lock().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) return;  // nobody has written since the study was made, or the folder cannot be read
    try {
        requireNotHeldElsewhere(folder, descriptor);
    } catch (...) {
        ::close(descriptor);
        throw;
    }
    ::close(descriptor);
}

}  // namespace database
