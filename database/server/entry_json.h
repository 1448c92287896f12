// What a station sends for one event, as the server's function store() takes it (functions.sql).
#pragma once

#include <string>

#include "database/session_store.h"

namespace database {

/// `before`: number of the participant's events before this one. The text has an id of its own, by which the server knows an
/// entry that it has already.
std::string entryJson(const SessionStore::Append& entry, int before);

}  // namespace database
