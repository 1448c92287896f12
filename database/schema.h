// The tables of study.db and how an older one becomes a newer one. Making a study is the migration
// from version 0; PRAGMA user_version holds the version, PRAGMA application_id says whose file it is.
#pragma once

#include "database/sqlite_connection.h"

namespace database {

inline constexpr int schemaVersion = 1;
inline constexpr int applicationId = 0x56324850;  ///< "V2HP"

/// Runs the steps from the file's version to schemaVersion, in the caller's transaction.
void migrate(const SqliteConnection& connection);

/// Throws badInput for a database that is not a study's or was made by a newer program.
/// Returns the file's version.
int checkedVersion(const SqliteConnection& connection);

}  // namespace database
