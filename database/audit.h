// The part of `vis2hap verify` that concerns the database: the file is whole, references lead to rows, the log is unbroken and
// agrees with the tables.
#pragma once

#include <string>
#include <vector>

#include "database/sqlite_connection.h"

namespace database {

/// One line for each fault; empty where there is none. Throws as requireTables() (schema.h), before any row is read.
std::vector<std::string> faultsOfDatabase(const SqliteConnection& sqlite);

/// The faults by which a copy of a study is not whole. Answers that no session writes are none of them: a login of a server may
/// have stored them, and the log that holds them can still be moved and rescued. Throws as faultsOfDatabase().
std::vector<std::string> faultsOfCopy(const SqliteConnection& sqlite);

}  // namespace database
