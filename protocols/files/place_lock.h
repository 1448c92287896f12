// The lock of a folder to which several programs add at the same time: each reads a file that is there, and writes it whole
// again.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>

namespace protocols {

/// Waits for another holder; the system releases the lock when the process ends in any way. Locks nothing where the folder does
/// not exist, or on a file system without such locks.
class PlaceLock {
public:
    explicit PlaceLock(const std::filesystem::path& folder)
        : m_descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
    {
        if (m_descriptor >= 0) ::flock(m_descriptor, LOCK_EX);
    }
    ~PlaceLock()
    {
        if (m_descriptor >= 0) ::close(m_descriptor);
    }
    PlaceLock(const PlaceLock&) = delete;
    PlaceLock& operator=(const PlaceLock&) = delete;

private:
    int m_descriptor;
};

}  // namespace protocols
