// Answers whose database was deleted, replaced or moved in mid-session: a whole copy of the open database is kept aside, and can
// be brought back.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "database/disk/study_folder.h"
#include "database/sqlite_connection.h"

namespace database {

/// Writes the open database into a new file "rescue-N.db" in the study folder; where the folder is gone, "NAME-rescue-N.db"
/// beside its place, or else in the folder for temporary files. Throws environmentFault where none of them takes it.
std::filesystem::path keepAside(const SqliteConnection& sqlite, const StudyFolder& folder);

/// The rescue files in the study folder and beside it, oldest first.
std::vector<std::filesystem::path> rescueFiles(const StudyFolder& folder);

struct Rescue {
    std::size_t events = 0;         ///< entries of the log that the study gained
    std::filesystem::path earlier;  ///< the database that stood there, kept under another name; empty where there was none
};

/// Puts the rescue file in the place of study.db. The log of the present study.db must be the beginning of the rescued one.
/// Throws badInput where it is not, or where the file is no database of a study; nothing is changed then. The caller holds the
/// write lock.
Rescue bringBack(const StudyFolder& folder, const std::filesystem::path& rescue);

}  // namespace database
