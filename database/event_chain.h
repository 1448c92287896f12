// The hash chain of the log: each entry's hash is the SHA-256 of the hash before it and of everything
// stored with it. Changing, removing or inserting a row breaks the chain from there on.
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

/// An event and all that its transaction stores.
struct LogEntry {
    EventRecord event;
    std::vector<ResponseRow> responses;
    std::vector<VoidRow> voids;
    std::vector<NoteRow> notes;
    std::optional<UnblindingRecord> unblinding;
};

/// Lower-case hexadecimal; `previous` is empty for the first entry.
std::string chainHash(const std::string& previous, const LogEntry& entry);

/// An act on the study itself, by nobody's session.
LogEntry actOnStudy(const std::string& kind, const nlohmann::ordered_json& payload, const std::string& wallTime);

/// Gives the entry the next sequence number, which it returns, and writes all its rows, in the caller's
/// transaction.
std::int64_t store(const SqliteConnection& connection, LogEntry entry);

/// SHA-256 over the rows that are fixed when a study is made: facts, fabrics, stimuli, trials and, from
/// version 2 of the schema, swatch codes and familiarisation. `version`: the schema's when it was made.
std::string hashOfFixedTables(const SqliteConnection& connection, int version);

}  // namespace database
