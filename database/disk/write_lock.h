// The lock of the only writer of a study folder: a flock(2) on an open file. The system releases it when the process ends in any
// way, so that no stale lock remains.
#pragma once

#include "database/disk/study_folder.h"

namespace database {

class WriteLock {
public:
    /// Throws environmentFault if another writer holds the lock (naming its process) or the folder cannot be written.
    explicit WriteLock(const StudyFolder& folder);
    ~WriteLock();
    WriteLock(const WriteLock&) = delete;
    WriteLock& operator=(const WriteLock&) = delete;

private:
    int m_descriptor = -1;
};

}  // namespace database
