// The lock of the only writer of a study folder: a flock(2) on an open file. The system releases it when the process ends in any
// way. Some network file systems keep locks to one computer. There the name of the computer, which stands in the file while the
// lock is held, keeps others away; a name that a killed program left must be removed by hand.
#pragma once

#include <sys/types.h>

#include "database/disk/study_folder.h"

namespace database {

/// In the message of a lock that another program of this computer holds.
inline constexpr const char* heldByAnotherProgram = "another program has the study open for writing";

class WriteLock {
public:
    /// Throws environmentFault if another writer holds the lock (naming its process and computer), or if the folder cannot be
    /// written. On a disk of other computers it also throws where the file names another computer than this one.
    explicit WriteLock(const StudyFolder& folder);
    ~WriteLock();
    WriteLock(const WriteLock&) = delete;
    WriteLock& operator=(const WriteLock&) = delete;

    /// Throws environmentFault where the file is no longer in its place: somebody deleted it, so that another writer may come. A
    /// file system that does not answer throws nothing.
    void requireInPlace() const;

private:
    StudyFolder m_folder;
    ::dev_t m_device = 0;
    ::ino_t m_inode = 0;  ///< of the open file: a share of which another computer deleted it no longer says
    int m_descriptor = -1;
};

/// For a short transaction without the lock. Throws environmentFault where the folder lies on a disk of other computers, and its
/// lock names another one than this: neither computer may see what the other one writes.
void requireNoOtherComputer(const StudyFolder& folder);

}  // namespace database
