// A study.db of schema 1 or 2, which the versions up to 0.6.0 made, as values. Only the upgrade reads it. A file code of such a
// study stands in the table of trials and beside each answer, so that a join names what was shown.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "database/event_chain.h"
#include "database/sqlite_connection.h"
#include "database/study_store.h"
#include "protocols/orders/allocation.h"

namespace database {

/// A row of a table with a number of its own.
template <class Row>
struct NumberedRow {
    qlonglong id = 0;
    qlonglong event = 0;
    Row row;
};

struct OlderTrial {
    protocols::BlindedTrial trial;  ///< without a sealed code
    protocols::FileCode image;
};

/// What an entry stores of the older chain.
struct OlderLinks {
    std::string previous, own;
};

struct OlderStudy {
    int version = 1;
    StudyFacts facts;  ///< without what schema 3 added
    std::string maskedKeySha256;
    std::map<protocols::FileCode, std::string> stimuli;                        ///< SHA-256
    std::vector<std::pair<std::string, protocols::FileCode>> familiarisation;  ///< name and image
    std::vector<std::vector<OlderTrial>> slots;
    std::map<qlonglong, EventRecord> events;
    std::map<qlonglong, OlderLinks> links;
    std::vector<NumberedRow<ResponseRow>> responses;  ///< the presentation code holds the file code
    std::vector<NumberedRow<VoidRow>> voids;          ///< their id is 0
    std::vector<NumberedRow<NoteRow>> notes;
    std::map<qlonglong, UnblindingRecord> unblindings;
};

/// Throws workFailed where the facts are missing, or where a row names a slot that the study lacks.
OlderStudy readOlderStudy(const SqliteConnection& sqlite);

using KeyEntries = std::map<protocols::FileCode, protocols::AllocationKey::Entry>;
/// What an older key says of each image. Empty for a bare database, which has no key.
using OlderKey = std::optional<KeyEntries>;

/// Copies the rows of a table that schema 3 did not change; none where the older schema lacks the table.
void copyOlderRows(const SqliteConnection& older, const SqliteConnection& made, const QString& table, int version);

/// The entries of the log with the rows that each transaction stored.
std::map<qlonglong, LogEntry> entriesOf(const OlderStudy& study);

/// One line a fault: the file, the chain, the end of the log, the fixed tables.
std::vector<std::string> faultsOfOlderLog(const SqliteConnection& sqlite, const OlderStudy& study);

/// Whether a recorded erasure emptied an entry of an older log.
bool isErasedInOlderLog(const LogEntry& entry, const std::map<std::string, qlonglong>& erasedBefore);

/// The participants whose answers were erased, with the entry that records it.
std::map<std::string, qlonglong> erasuresInOlderLog(const OlderStudy& study);

}  // namespace database
