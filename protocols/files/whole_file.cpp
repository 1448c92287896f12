#include "protocols/files/whole_file.h"

#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>
#include <vector>

#include "protocols/files/disk_sync.h"
#include "protocols/files/errors.h"
#include "protocols/files/open_files.h"
#include "protocols/files/unfinished.h"
#include "protocols/process/owner_only.h"

namespace protocols {

namespace {

namespace fs = std::filesystem;

// Reasons beside those of errno, which are positive.
constexpr int nobodyWrites = -1, isDevice = -2, isTooLarge = -3;

Error hasTooManyBytes(const fs::path& file, const std::string& bytes, std::uint64_t mostBytes)
{
    return badInput(
        {"has " + bytes + " bytes", file.string(), "at most " + std::to_string(mostBytes) + " bytes", "check the path"});
}

Error cannotRead(const fs::path& file, int reason, std::uint64_t mostBytes = largestFile)
{
    if (reason == nobodyWrites)
        return badInput({"nobody wrote into this pipe for " + std::to_string(longestWaitForPipeS) + " s", file.string(),
                         "a file, or a pipe into which a program writes", "start that program first, or name a file"});
    if (reason == isDevice) return badInput({"is a device", file.string(), "a file or a pipe", "check the path"});
    if (reason == isTooLarge) return hasTooManyBytes(file, "more than " + std::to_string(mostBytes), mostBytes);
    if (isTooManyOpenFiles(reason)) return tooManyOpenFiles(file.string());
    return badInput({std::string("cannot be read (") + std::strerror(reason) + ")", file.string(), "a readable file",
                     "check the path and its permissions"});
}

Error cannotWrite(const fs::path& file, int reason)
{
    if (isTooManyOpenFiles(reason)) return tooManyOpenFiles(file.string());
    return environmentFault({std::string("cannot be written (") + std::strerror(reason) + ")", file.string(),
                             "a writable folder with free space", "free space or choose another folder"});
}

Error isTaken(const fs::path& file)
{
    return badInput({"the file exists", file.string(), "the name of a new file", "choose another name; nothing was written"});
}

/// An open file, closed with this value.
class Descriptor {
public:
    Descriptor(const fs::path& file, int flags, mode_t mode = 0) : m_number(::open(file.c_str(), flags | O_CLOEXEC, mode)) {}
    /// One more of an open file, with its position.
    explicit Descriptor(int other) : m_number(::fcntl(other, F_DUPFD_CLOEXEC, 0)) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : m_number(std::exchange(other.m_number, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    bool isOpen() const { return m_number >= 0; }
    int number() const { return m_number; }
    /// False where the file system reports a failed write only now.
    bool close() { return m_number < 0 || ::close(std::exchange(m_number, -1)) == 0; }

private:
    int m_number;
};

/// The kind of a file, as bits of stat(); 0 where there is none.
mode_t kindAt(const fs::path& file)
{
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 ? status.st_mode & S_IFMT : 0;
}

/// Devices such as /dev/zero never end; a terminal does.
bool isEndless(mode_t kind, int descriptor) { return (kind == S_IFCHR && ::isatty(descriptor) == 0) || kind == S_IFBLK; }

/// Waits for the first bytes of a pipe, into which perhaps nobody writes.
bool getsSomething(int pipe)
{
    pollfd waiting{pipe, POLLIN, 0};
    return ::poll(&waiting, 1, 1000 * longestWaitForPipeS) > 0 && ::fcntl(pipe, F_SETFL, 0) == 0;
}

/// Gives every block to `take` until that returns false. Returns 0 or the reason of the failure.
int eachBlock(const fs::path& file, const std::function<bool(std::string_view)>& take)
{
    const mode_t kind = kindAt(file);
    const bool waits = kind == S_IFIFO;
    // Some files of the kernel look regular and wait for ever, such as /proc/kmsg.
    const Descriptor open(file, waits || kind == S_IFREG ? O_RDONLY | O_NONBLOCK : O_RDONLY);
    if (!open.isOpen()) return errno;
    if (isEndless(kind, open.number())) return isDevice;
    if (waits && !getsSomething(open.number())) return nobodyWrites;
    std::vector<char> block(std::size_t{1} << 16);
    while (true) {
        const ssize_t count = ::read(open.number(), block.data(), block.size());
        if (count == 0) return 0;
        if (count < 0 && errno != EINTR) return errno;
        if (count > 0 && !take({block.data(), static_cast<std::size_t>(count)})) return 0;
    }
}

/// Returns 0 or the reason of the failure.
int readInto(const fs::path& file, std::string& bytes, std::uint64_t mostBytes = largestFile)
{
    std::error_code unknown;
    if (const auto size = fs::file_size(file, unknown); !unknown) {
        if (size > mostBytes) return isTooLarge;
        bytes.reserve(size);
    }
    const int reason = eachBlock(file, [&](std::string_view block) {
        bytes += block;
        return bytes.size() <= mostBytes;
    });
    return bytes.size() > mostBytes ? isTooLarge : reason;
}

const char* kindOf(mode_t mode)
{
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

/// Opens a regular file; `size` receives its size. The kind is checked before, because opening a device or a pipe may wait or
/// have effects, and after, because the file may have been replaced.
Descriptor regularFile(const fs::path& file, std::uint64_t& size)
{
    struct stat status {};
    const auto requireRegular = [&] {
        if (!S_ISREG(status.st_mode))
            throw badInput({std::string("is ") + kindOf(status.st_mode), file.string(), "a regular file", "check the path"});
    };
    if (::stat(file.c_str(), &status) != 0) throw cannotRead(file, errno);
    requireRegular();
    Descriptor open(file, O_RDONLY | O_NONBLOCK);
    if (!open.isOpen() || ::fstat(open.number(), &status) != 0) throw cannotRead(file, errno);
    requireRegular();
    size = static_cast<std::uint64_t>(status.st_size);
    return open;
}

/// Fewer bytes where the file ends before.
std::string firstBytes(const fs::path& file, const Descriptor& open, std::size_t count)
{
    std::string bytes(count, '\0');
    std::size_t done = 0;
    while (done < count) {
        const ssize_t got = ::read(open.number(), bytes.data() + done, count - done);
        if (got == 0) break;
        if (got > 0)
            done += static_cast<std::size_t>(got);
        else if (errno != EINTR)
            throw cannotRead(file, errno);
    }
    bytes.resize(done);
    return bytes;
}

bool writeAll(int descriptor, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno == EAGAIN) {  // a full pipe that its owner made not to wait
            pollfd room{descriptor, POLLOUT, 0};
            if (::poll(&room, 1, -1) < 0 && errno != EINTR) return false;
            continue;
        }
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

bool isDeviceOrPipe(const fs::path& file)
{
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

/// The number of an open file of this process, as /dev/stdout, /dev/fd/1 and /proc/self/fd/1 name one; -1 for any other name. A
/// link elsewhere does not lead to one: somebody may have put it there.
int openFileOfName(fs::path file)
{
    constexpr int mostLinks = 4;
    std::error_code none;
    for (int links = 0; links < mostLinks; ++links) {
        const fs::path target = fs::read_symlink(file, none);
        if (none) return -1;
        const fs::path folder = fs::canonical(file.has_parent_path() ? file.parent_path() : fs::path("."), none);
        if (!none && folder == fs::canonical("/proc/self/fd", none) && !none) {
            const std::string digits = file.filename().string();
            int number = -1;
            const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
            return problem == std::errc{} && end == digits.data() + digits.size() ? number : -1;
        }
        if (none || folder != "/dev") return -1;
        file = folder / target;
    }
    return -1;
}

using MakeBytes = std::function<void(const TakeBytes&)>;

/// Writes what `make` gives. Returns 0 or the reason of the first failure; nothing is written after it.
int writePieces(int descriptor, const MakeBytes& make)
{
    int reason = 0;
    make([&](std::string_view bytes) {
        if (reason == 0 && !writeAll(descriptor, bytes)) reason = errno;
    });
    return reason;
}

/// A rename would put a file in the place of the device.
void writeThrough(const fs::path& file, Descriptor open, const MakeBytes& make)
{
    if (!open.isOpen()) throw cannotWrite(file, errno);
    if (const int reason = writePieces(open.number(), make); reason != 0) throw cannotWrite(file, reason);
    if (!open.close()) throw cannotWrite(file, errno);
}

/// Returns 0 or the reason of the failure.
int writeTemporary(const fs::path& temporary, const MakeBytes& make, Sync sync, Readers readers)
{
    ::unlink(temporary.c_str());  // left by an earlier process of this number
    const bool isOwners = readers == Readers::OwnerOnly || filesAreKeptToOwner();
    Descriptor open(temporary, O_WRONLY | O_CREAT | O_EXCL, isOwners ? 0600 : 0666);
    if (!open.isOpen()) return errno;
    if (const int reason = writePieces(open.number(), make); reason != 0) return reason;
    if (sync == Sync::Now && ::fsync(open.number()) != 0) return errno;
    return open.close() ? 0 : errno;
}

/// For a file system that knows no renaming to a new name only. A second name of the file replaces nothing either. Sticks have no
/// second names; there a file that somebody makes in the last moment is replaced. Returns 0 or the reason of the failure.
int putByLink(const fs::path& finished, const fs::path& file)
{
    if (::link(finished.c_str(), file.c_str()) == 0) {
        ::unlink(finished.c_str());
        return 0;
    }
    if (errno != EPERM && errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) return errno;
    std::error_code unknown;
    if (fs::exists(fs::symlink_status(file, unknown))) return EEXIST;
    return ::rename(finished.c_str(), file.c_str()) == 0 ? 0 : errno;
}

/// Removes the file of this name unless it is kept.
class Unfinished {
public:
    explicit Unfinished(fs::path file) : m_file(std::move(file)) {}
    ~Unfinished()
    {
        if (!m_isKept) ::unlink(m_file.c_str());
    }
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

    const fs::path& path() const { return m_file; }
    void keep() { m_isKept = true; }

private:
    fs::path m_file;
    bool m_isKept = false;
};

}  // namespace

std::string readWholeFile(const fs::path& file, std::uint64_t mostBytes)
{
    std::string bytes;
    if (const int reason = readInto(file, bytes, mostBytes); reason != 0) throw cannotRead(file, reason, mostBytes);
    return bytes;
}

std::optional<std::string> readIfPossible(const fs::path& file)
{
    std::string bytes;
    const int reason = readInto(file, bytes);
    if (isTooManyOpenFiles(reason)) throw cannotRead(file, reason);  // not a fault of the file
    return reason == 0 ? std::optional(std::move(bytes)) : std::nullopt;
}

std::string readRegularFile(const fs::path& file, std::uint64_t mostBytes)
{
    std::uint64_t size = 0;
    const Descriptor open = regularFile(file, size);
    if (size > mostBytes) throw hasTooManyBytes(file, std::to_string(size), mostBytes);
    return firstBytes(file, open, static_cast<std::size_t>(size));
}

std::string beginningOf(const fs::path& file, std::size_t count)
{
    std::uint64_t size = 0;
    const Descriptor open = regularFile(file, size);
    return firstBytes(file, open, static_cast<std::size_t>(std::min<std::uint64_t>(size, count)));
}

void readInBlocks(const fs::path& file, const std::function<void(std::string_view)>& take)
{
    const auto takeOn = [&](std::string_view block) {
        take(block);
        return true;
    };
    if (const int reason = eachBlock(file, takeOn); reason != 0) throw cannotRead(file, reason);
}

void writeWholeFile(const fs::path& file, std::string_view bytes, Sync sync, Readers readers)
{
    writeInPieces(
        file, [&](const TakeBytes& take) { take(bytes); }, sync, readers);
}

void writeInPieces(const fs::path& file, const MakeBytes& make, Sync sync, Readers readers)
{
    if (const int number = openFileOfName(file); number >= 0) return writeThrough(file, Descriptor(number), make);
    if (isDeviceOrPipe(file)) return writeThrough(file, Descriptor(file, O_WRONLY), make);
    if (sync == Sync::Now) removeAbandoned(file);
    Unfinished temporary(unfinishedName(file));
    int reason = writeTemporary(temporary.path(), make, sync, readers);
    if (reason == 0 && ::rename(temporary.path().c_str(), file.c_str()) != 0) reason = errno;
    if (reason != 0) throw cannotWrite(file, reason);
    temporary.keep();
    if (sync == Sync::Now) syncFolder(file.parent_path());
}

void putFileInPlace(const fs::path& finished, const fs::path& file)
{
    syncFile(finished);
    if (::rename(finished.c_str(), file.c_str()) != 0) throw cannotWrite(file, errno);
    syncFolder(file.parent_path());
}

void requireNewFile(const fs::path& file)
{
    if (fs::exists(fs::symlink_status(file))) throw isTaken(file);
}

void putNewFileInPlace(const fs::path& finished, const fs::path& file)
{
    syncFile(finished);
    int reason = ::renameat2(AT_FDCWD, finished.c_str(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE) == 0 ? 0 : errno;
    if (reason == EINVAL || reason == ENOSYS || reason == ENOTSUP) reason = putByLink(finished, file);
    if (reason == EEXIST) throw isTaken(file);
    if (reason != 0) throw cannotWrite(file, reason);
    syncFolder(file.parent_path());
}

void copyBytes(const fs::path& from, const fs::path& to)
{
    Descriptor open(to, O_WRONLY | O_CREAT | O_EXCL, 0600);
    if (!open.isOpen()) throw cannotWrite(to, errno);
    Unfinished copy(to);
    const int reason = writePieces(open.number(), [&](const TakeBytes& take) { readInBlocks(from, take); });
    if (reason != 0) throw cannotWrite(to, reason);
    if (!open.close()) throw cannotWrite(to, errno);
    copy.keep();
}

void requireWritable(const fs::path& file)
{
    if (fs::is_directory(file)) throw badInput({"is a folder", file.string(), "the name of a file to write", ""});
    if (const int number = openFileOfName(file); number >= 0) {
        const int flags = ::fcntl(number, F_GETFL);
        if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) throw cannotWrite(file, EBADF);
        return;
    }
    if (isDeviceOrPipe(file)) {
        if (::access(file.c_str(), W_OK) != 0) throw cannotWrite(file, errno);
        return;
    }
    const fs::path temporary = unfinishedName(file);
    const int reason = writeTemporary(
        temporary, [](const TakeBytes&) {}, Sync::Later, Readers::AsUsual);
    ::unlink(temporary.c_str());
    if (reason != 0) throw cannotWrite(file, reason);
}

}  // namespace protocols
