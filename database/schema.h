// The tables of study.db and how an older one becomes a newer one. Making a study is the migration
// from version 0; PRAGMA user_version holds the version, PRAGMA application_id says whose file it is.
#pragma once

#include "database/sqlite_connection.h"

namespace database {

inline constexpr int schemaVersion = 2;
inline constexpr int applicationId = 0x56324850;  ///< "V2HP"

/// Runs the steps from the file's version to schemaVersion, in the caller's transaction. An older file
/// needs foreign keys off meanwhile, for a table is rebuilt.
void migrate(const SqliteConnection& connection);

/// Tables whose rows are only ever added.
void guardAgainstChanges(const SqliteConnection& connection, const char* table);
void unguard(const SqliteConnection& connection, const char* table);

/// Throws badInput for a database that is not a study's or was made by a newer program.
/// Returns the file's version.
int checkedVersion(const SqliteConnection& connection);

}  // namespace database
