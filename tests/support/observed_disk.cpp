#include "tests/support/observed_disk.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <mutex>
#include <optional>

namespace {

using tests::support::DiskCall;
using tests::support::DiskStep;

struct Observation {
    std::filesystem::path folder;
    std::vector<DiskStep> steps;
    std::optional<std::size_t> last, failing;
    int reason = 0;
};

std::mutex guard;
std::optional<Observation> observation;
constexpr std::size_t longestWrite = 1000;  // bytes, so that a file takes several steps and may end half-written
thread_local bool isLooking = false;        // the observer's own calls are not observed

std::filesystem::path fileOf(int descriptor)
{
    std::array<char, 4096> name{};
    const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
    const ssize_t length = ::readlink(link.c_str(), name.data(), name.size());
    return length > 0 ? std::filesystem::path(std::string(name.data(), static_cast<std::size_t>(length))) : "";
}

/// Records an operation and returns the error number with which it must fail, or 0.
int step(DiskCall call, const std::filesystem::path& file)
{
    if (isLooking) return 0;
    const std::lock_guard lock(guard);
    if (!observation || !file.string().starts_with(observation->folder.string())) return 0;
    isLooking = true;
    const std::size_t number = observation->steps.size();
    if (observation->last == number) ::_exit(7);
    observation->steps.push_back({call, file});
    const int reason = observation->failing == number ? observation->reason : 0;
    isLooking = false;
    return reason;
}

bool watches(int descriptor)
{
    const std::lock_guard lock(guard);
    return observation && fileOf(descriptor).string().starts_with(observation->folder.string());
}

int failed(int reason)
{
    errno = reason;
    return -1;
}

}  // namespace

// The linker prefers these definitions to those of the C library.
extern "C" {

int fsync(int descriptor)
{
    if (const int reason = step(DiskCall::Sync, fileOf(descriptor)); reason != 0) return failed(reason);
    return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

int syncfs(int descriptor) noexcept
{
    if (const int reason = step(DiskCall::SyncAll, fileOf(descriptor)); reason != 0) return failed(reason);
    return static_cast<int>(::syscall(SYS_syncfs, descriptor));
}

ssize_t write(int descriptor, const void* bytes, size_t count)
{
    if (const int reason = step(DiskCall::Write, fileOf(descriptor)); reason != 0) return failed(reason);
    const bool isWatched = watches(descriptor);
    return ::syscall(SYS_write, descriptor, bytes, isWatched ? std::min(count, longestWrite) : count);
}

int rename(const char* from, const char* to) noexcept
{
    if (const int reason = step(DiskCall::Rename, to); reason != 0) return failed(reason);
    return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int renameat2(int fromFolder, const char* from, int toFolder, const char* to, unsigned flags) noexcept
{
    if (const int reason = step(DiskCall::Exchange, to); reason != 0) return failed(reason);
    return static_cast<int>(::syscall(SYS_renameat2, fromFolder, from, toFolder, to, flags));
}
}

namespace tests::support {

ObservedDisk::ObservedDisk(std::filesystem::path folder)
{
    const std::lock_guard lock(guard);
    observation = Observation{std::filesystem::canonical(folder), {}, {}, {}, 0};
}

ObservedDisk::~ObservedDisk()
{
    const std::lock_guard lock(guard);
    observation.reset();
}

std::vector<DiskStep> ObservedDisk::steps() const
{
    const std::lock_guard lock(guard);
    return observation->steps;
}

std::size_t ObservedDisk::count(DiskCall call) const
{
    const std::vector<DiskStep> all = steps();
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const DiskStep& one) { return one.call == call; }));
}

void ObservedDisk::dieBefore(std::size_t number)
{
    const std::lock_guard lock(guard);
    observation->last = number;
}

void ObservedDisk::failAt(std::size_t number, int reason)
{
    const std::lock_guard lock(guard);
    observation->failing = number;
    observation->reason = reason;
}

}  // namespace tests::support
