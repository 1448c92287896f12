// Everything that adds to an existing study: places taken, events with their answers, protocols, unblindings. Each function is
// one transaction.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "database/sqlite_connection.h"
#include "database/study_store.h"

namespace database {

/// A fact about a participant with the salt of its commitment in the log, in hexadecimal.
struct SaltedFact {
    std::string fact, value, salt;
};
std::vector<SaltedFact> salted(const std::vector<std::pair<std::string, std::string>>& facts);
/// The payload with the commitments to the facts; as it is without facts.
std::string withCommitments(const std::string& payloadJson, const std::vector<SaltedFact>& facts);

/// As StudyStore::enrol. `wanted`: this place instead of the next free one; throws badInput where it is taken or missing.
Slot enrolIn(const SqliteConnection& sqlite, const protocols::ParticipantId& participant, ParticipantKind kind,
             std::optional<int> wanted = {});

/// As StudyStore::append.
void appendTo(const SqliteConnection& sqlite, const StudyStore::Append& entry);

/// As StudyStore::takeProtocol.
void takeProtocolInto(const SqliteConnection& sqlite, const std::string& json, const std::string& who, const std::string& why);

/// As StudyStore::recordUnblinding.
void recordUnblindingIn(const SqliteConnection& sqlite, const UnblindingRecord& record);

}  // namespace database
