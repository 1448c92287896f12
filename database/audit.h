// The part of `vis2hap verify` that concerns the database: the file is whole, references lead to rows, the log is unbroken and
// agrees with the tables.
#pragma once

#include <string>
#include <vector>

#include "database/sqlite_connection.h"

namespace database {

/// One line for each fault; empty where there is none.
std::vector<std::string> faultsOfDatabase(const SqliteConnection& sqlite);

}  // namespace database
