// The tables of study.db as they are, for the data sheet: names, columns, and numbers of rows.
#pragma once

#include <string>
#include <vector>

#include "database/study_store.h"

namespace database {

struct StoredTable {
    std::string name;
    std::vector<std::string> columns;
    std::int64_t rows = 0;
};

/// In the order in which they were made, without those that SQLite keeps for itself.
std::vector<StoredTable> storedTables(const StudyStore& store);

}  // namespace database
