// The SQL of a study on a server, which the program carries with it (database/server/sql).
#pragma once

#include <QString>

namespace database {

/// "tables", "functions" or "roles".
QString serverScript(const char* name);

}  // namespace database
