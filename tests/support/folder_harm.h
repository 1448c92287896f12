// What somebody can do to the folder of a study while a session is open, and how the experimenter puts it right.
#pragma once

#include <span>

#include "database/disk/study_folder.h"

namespace tests::support {

enum class FolderHarm {
    DatabaseDeleted,
    DatabaseReplaced,
    DatabaseRenamed,
    LogDeleted,
    FolderMoved,
    DatabaseEmptied,      ///< `: > study.db`, the same file with other bytes
    DatabaseOverwritten,  ///< in place, with as many bytes and the same beginning
    LogEmptied,
    LogOverwritten,
    BothEmptied,
};

struct NamedHarm {
    FolderHarm harm;
    const char* name;
};
std::span<const NamedHarm> folderHarms();

void doHarm(FolderHarm harm, const database::StudyFolder& folder);

/// Moves the folder back, or removes the database that is in the way of the rescue file. A damaged one is not in the way.
void putRight(FolderHarm harm, const database::StudyFolder& folder);

}  // namespace tests::support
