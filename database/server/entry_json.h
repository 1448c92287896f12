// What a station sends for one event, as the server's function store() takes it (functions.sql).
#pragma once

#include <string>

#include "database/session_store.h"

namespace database {

struct EntryToSend {
    std::string json;
    std::string payload;  ///< of the event, as the server's log then holds it: with the commitments to the facts
};

/// `before`: number of the participant's events before this one. The text has an id of its own, by which the server knows an
/// entry that it has already. The salts of the facts are drawn here, so each call makes another entry.
EntryToSend entryToSend(const SessionStore::Append& entry, int before);

}  // namespace database
