// The tables of study.db. PRAGMA user_version holds the version of the schema, PRAGMA application_id identifies the program.
#pragma once

#include <QString>
#include <string>
#include <vector>

#include "database/sqlite_connection.h"

namespace database {

inline constexpr int schemaVersion = 3;
inline constexpr int applicationId = 0x56324850;  ///< "V2HP"

/// Makes all tables, the view and the triggers in an empty file, in the caller's transaction.
void makeSchema(const SqliteConnection& connection);

/// The latest answer to each question of each attempt, with the time stamps of the first: event, corrections, voided, wall_time,
/// note and sitting, then ResponseColumns::OfCurrentAnswers. It reads tables only, so that a view that somebody changed cannot
/// change a result.
QString currentAnswersQuery();
inline constexpr int firstResponseColumn = 6;  ///< of currentAnswersQuery()

/// Makes a table refuse UPDATE and DELETE by triggers, or lifts that.
void guardAgainstChanges(const SqliteConnection& connection, const char* table);
void unguard(const SqliteConnection& connection, const char* table);

/// One line for each table, index, view or trigger that is missing, unknown, or not the one that makeSchema() makes.
std::vector<std::string> faultsOfSchema(const SqliteConnection& connection);

/// One line for each column with integers that this program never writes: it reads them as 32 bits or as yes and no, and SQL
/// would see other numbers.
std::vector<std::string> faultsOfIntegers(const SqliteConnection& connection);

/// Throws workFailed where a view or a virtual table stands in the place of a table of the study. A query of it may never end.
void requireTables(const SqliteConnection& connection);

/// The file's schema version. Throws badInput for a database that is no study's or has a newer schema, and as requireTables().
int checkedVersion(const SqliteConnection& connection);

}  // namespace database
