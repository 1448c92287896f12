// Observer of the disk operations of this process: writes, syncs and renames in their order, each with its file. A test can also
// end the process at one of them, or let writes and syncs fail. The test program defines these functions of the C library itself,
// so the product needs no interface for tests.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tests::support {

enum class DiskCall { Write, Sync, SyncAll, Rename, Exchange };

/// One disk operation.
struct DiskStep {
    DiskCall call;
    std::filesystem::path file;  ///< for a rename, the new name
    bool operator==(const DiskStep&) const = default;
};

/// Records every disk operation below `folder` during its lifetime.
class ObservedDisk {
public:
    explicit ObservedDisk(std::filesystem::path folder);
    ~ObservedDisk();
    ObservedDisk(const ObservedDisk&) = delete;
    ObservedDisk& operator=(const ObservedDisk&) = delete;

    std::vector<DiskStep> steps() const;
    std::size_t count(DiskCall call) const;

    /// Ends the process before the operation of this number, from 0.
    void dieBefore(std::size_t step);
    /// Lets the operation of this number fail with an error number of the C library.
    void failAt(std::size_t step, int reason);
};

}  // namespace tests::support
