// What an open study store holds; shared by the store's source files only.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "database/sqlite_connection.h"
#include "database/study_store.h"
#include "database/write_lock.h"

namespace database {

struct StudyStore::Connection {
    StudyFolder folder;
    std::unique_ptr<WriteLock> lock;  ///< null for a reader
    SqliteConnection sqlite;
};

/// ["F03","F01","F05"] and back. Throws workFailed where the stored text is not such a list.
std::string jsonOf(const std::vector<std::string>& texts);
std::vector<std::string> textsOf(const std::string& json);
std::string jsonOf(const std::vector<protocols::FabricId>& fabrics);
std::vector<protocols::FabricId> fabricsOf(const std::string& json);

/// The system's wall clock, ISO 8601 with milliseconds and zone, for acts outside a session.
std::string wallTimeNow();

}  // namespace database
