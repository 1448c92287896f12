// The hash chain of the log: the hash of an entry is the SHA-256 of the hash before it and of everything stored with the entry.
// A changed, removed or inserted row breaks the chain from there on.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "database/response_columns.h"
#include "database/sqlite_connection.h"
#include "database/study_store.h"

namespace database {

struct VoidRow {
    std::string participant;
    int trial = 0;
    int attempt = 1;
};

struct NoteRow {
    std::string participant;
    int trial = 0;
    int attempt = 1;
    std::optional<std::string> question;
    std::string text;
    bool isFlag = false;
};

/// An event and all rows that its transaction stores.
struct LogEntry {
    EventRecord event;
    std::vector<ResponseRow> responses;
    std::vector<VoidRow> voids;
    std::vector<NoteRow> notes;
    std::optional<UnblindingRecord> unblinding;
};

/// The entry's hash in lower-case hexadecimal. `previous`: the hash before it; empty for the first entry.
std::string chainHash(const std::string& previous, const LogEntry& entry);

/// An entry for an act on the study itself, outside any session.
LogEntry actOnStudy(const std::string& kind, const nlohmann::ordered_json& payload, const std::string& wallTime);

/// Writes the entry with the next sequence number and all its rows, in the caller's transaction. Returns the number.
std::int64_t store(const SqliteConnection& connection, LogEntry entry);

/// SHA-256 over the rows that never change: facts, fabrics, stimuli, trials and, from schema version 2, swatch codes and
/// familiarisation. `version`: the schema version that made the study.
std::string hashOfFixedTables(const SqliteConnection& connection, int version);

}  // namespace database
