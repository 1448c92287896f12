// What this process asks of the disk: writes, syncs and renames in their order, each with its file. A test can also let
// the process die at one of them, or let writes and syncs fail. It works by defining the C library's functions in the
// test's own program, so that the product needs no seam.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tests::support {

enum class DiskCall { Write, Sync, SyncAll, Rename, Exchange };

struct DiskStep {
    DiskCall call;
    std::filesystem::path file;  ///< of a rename: the new name
    bool operator==(const DiskStep&) const = default;
};

/// While one exists, every step that lies below `folder` is kept.
class ObservedDisk {
public:
    explicit ObservedDisk(std::filesystem::path folder);
    ~ObservedDisk();
    ObservedDisk(const ObservedDisk&) = delete;
    ObservedDisk& operator=(const ObservedDisk&) = delete;

    std::vector<DiskStep> steps() const;
    std::size_t count(DiskCall call) const;

    /// The process ends before it takes the step of this number, from 0.
    void dieBefore(std::size_t step);
    /// The step of this number fails with an error number of the C library.
    void failAt(std::size_t step, int reason);
};

}  // namespace tests::support
