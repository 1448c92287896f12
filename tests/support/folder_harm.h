// What somebody can do to the folder of a study while a session is open, and how the experimenter puts it right.
#pragma once

#include <span>

#include "database/disk/study_folder.h"

namespace tests::support {

enum class FolderHarm { DatabaseDeleted, DatabaseReplaced, DatabaseRenamed, LogDeleted, FolderMoved };

struct NamedHarm {
    FolderHarm harm;
    const char* name;
};
std::span<const NamedHarm> folderHarms();

void doHarm(FolderHarm harm, const database::StudyFolder& folder);

/// Moves the folder back, or removes the database that is in the way of the rescue file.
void putRight(FolderHarm harm, const database::StudyFolder& folder);

}  // namespace tests::support
