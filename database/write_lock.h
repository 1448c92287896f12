// The lock of the one writer of a study folder. It is a flock(2) on an open file, so the system
// releases it when its process ends, however it ends; nothing stale is ever left behind.
#pragma once

#include "database/study_folder.h"

namespace database {

class WriteLock {
public:
    /// Throws environmentFault where another writer holds it (naming its process) or the folder cannot
    /// be written.
    explicit WriteLock(const StudyFolder& folder);
    ~WriteLock();
    WriteLock(const WriteLock&) = delete;
    WriteLock& operator=(const WriteLock&) = delete;

private:
    int m_descriptor = -1;
};

}  // namespace database
