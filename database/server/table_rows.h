// The rows of a study's tables on their way between a file and a server. Both have the same tables with the same columns.
#pragma once

#include <string>
#include <vector>

#include "database/server/server_connection.h"
#include "database/sqlite_connection.h"

namespace database {

/// Inserts all rows of the file into the empty tables of the server.
void sendRows(const SqliteConnection& file, const ServerConnection& server);

/// Inserts all rows of the server into the empty tables of the file. Read them in one ServerTransaction::Kind::ReadOneState.
void fetchRows(const ServerConnection& server, const SqliteConnection& file);

/// SHA-256 over all rows of all tables: equal for a study and its faithful copy.
std::string hashOfAllRows(const SqliteConnection& file);

}  // namespace database
