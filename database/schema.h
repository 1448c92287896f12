// The tables of study.db and the migrations from older versions. A new study is a migration from version 0. PRAGMA user_version
// holds the version, PRAGMA application_id identifies the program.
#pragma once

#include "database/sqlite_connection.h"

namespace database {

inline constexpr int schemaVersion = 2;
inline constexpr int applicationId = 0x56324850;  ///< "V2HP"

/// Migrates the file to schemaVersion in the caller's transaction. Foreign keys must be off for an older file, because a table is
/// rebuilt.
void migrate(const SqliteConnection& connection);

/// Makes a table refuse UPDATE and DELETE by triggers, or lifts that.
void guardAgainstChanges(const SqliteConnection& connection, const char* table);
void unguard(const SqliteConnection& connection, const char* table);

/// The file's schema version. Throws badInput for a database that is no study's or has a newer schema.
int checkedVersion(const SqliteConnection& connection);

}  // namespace database
