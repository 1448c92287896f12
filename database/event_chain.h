// The hash chain of the log. An entry has a clear part (number, participant, sitting, kind, and the places of its rows) and a
// content (payload, stamps, answers, notes). The commitment is the SHA-256 of a random salt and the content; the hash is that of
// the hash before it, the clear part and the commitment. A changed, removed or inserted row breaks the chain from there on. An
// erasure removes content and salt: the chain still verifies, and nobody can guess the content from its commitment.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
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

/// A row of `finger_samples`. The chain covers the hash of the samples, so that an audit need not keep them.
struct FingerRow {
    std::string participant;
    int trial = 0;
    int attempt = 1;
    std::int64_t beganAt = 0;  ///< time of the first sample
    int count = 0;
    int leftOut = 0;
    std::string samples = {};  ///< finger_text.h; an audit leaves it empty
    std::string samplesSha256 = {};
};

/// An event and all rows that its transaction stores.
struct LogEntry {
    EventRecord event;
    std::vector<ResponseRow> responses;
    std::vector<VoidRow> voids;
    std::vector<NoteRow> notes;
    std::optional<UnblindingRecord> unblinding;
    std::vector<FingerRow> finger = {};
};

/// The places of the entry's rows, which stay after an erasure: canonical bytes, empty for an entry without rows.
std::string placesOf(const LogEntry& entry);

/// `salt`: hexadecimal.
std::string commitmentOf(const LogEntry& entry, const std::string& salt);

/// The entry's hash in lower-case hexadecimal. `previous`: the hash before it; empty for the first entry.
std::string chainHash(const std::string& previous, const EventRecord& event, const std::string& places,
                      const std::string& commitment);

/// Whether the entry belongs to a presentation: nearly all entries do, and they change no state.
bool isOfTrial(const EventRecord& event);

/// The kind of the entry that an upgrade from an older schema leaves.
inline constexpr const char* upgradedKind = "upgraded";
/// What the log keeps of a fact about a participant: the hash of a salt, which an erasure removes, and the value.
std::string commitmentOfFact(const std::string& salt, const std::string& fact, const std::string& value);

/// An entry for an act on the study itself, outside any session.
LogEntry actOnStudy(const std::string& kind, const nlohmann::ordered_json& payload, const std::string& wallTime);

/// Writes the entry with the next sequence number and all its rows, in the caller's transaction. Returns the number. Except in
/// entries of trials, the payload names the last act (evidence/acts.h), if there is one: "acts": {"number", "sha256"}.
std::int64_t store(const SqliteConnection& connection, LogEntry entry);

/// Writes an entry under the number that it has, without its rows, and returns its hash. `salt`: empty for an erased entry.
std::string storeUnderItsNumber(const SqliteConnection& connection, const LogEntry& entry, const std::string& previous,
                                const std::string& salt);

/// An act on the study (evidence/acts.h) as its own chain covers it.
struct ChainedAct {
    std::int64_t number = 0;     ///< from 1 without gaps
    std::string kind, wallTime;  ///< as in Act
    std::string details;         ///< JSON: who, program, host, path, entry and hash of the log's head at that time, note
    std::string previous, hash;
};
/// SHA-256 of "act", previous, number, kind, details and wallTime.
std::string chainHash(const ChainedAct& act);
/// In the order of their numbers.
std::vector<ChainedAct> chainedActsIn(const SqliteConnection& connection);
/// Stores the act behind the last one, in the caller's transaction; its number and hashes are set here.
void appendAct(const SqliteConnection& connection, ChainedAct act);
struct KeptActs {
    std::size_t added = 0;
    std::size_t altered = 0;  ///< left out
};
/// Adds the acts of a database that is put aside, which `into` lacks. Where `into` has every act before them, they keep their
/// hashes, so that heads given out for them still verify. Throws where the acts cannot be read; then none is added.
KeptActs keepActsOf(const SqliteConnection& earlier, const SqliteConnection& into);

/// 32 random bytes, in hexadecimal.
std::string drawnSalt();

/// SHA-256 over the results of queries, each with its text.
std::string hashOfRows(const SqliteConnection& connection, std::span<const char* const> queries);

/// SHA-256 over the rows that never change: facts, fabrics, stimuli, slots, trials, swatch codes and familiarisation.
std::string hashOfFixedTables(const SqliteConnection& connection);

}  // namespace database
