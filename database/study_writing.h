// Everything that adds to an existing study: places taken, events with their answers, protocols, unblindings. Each function is
// one transaction.
#pragma once

#include <string>

#include "database/sqlite_connection.h"
#include "database/study_store.h"

namespace database {

/// As StudyStore::enrol.
Slot enrolIn(const SqliteConnection& sqlite, const protocols::ParticipantId& participant, ParticipantKind kind);

/// As StudyStore::setSlotState.
void setSlotStateIn(const SqliteConnection& sqlite, const protocols::ParticipantId& participant, SlotState state);

/// As StudyStore::append.
void appendTo(const SqliteConnection& sqlite, const StudyStore::Append& entry);

/// As StudyStore::takeProtocol.
void takeProtocolInto(const SqliteConnection& sqlite, const std::string& json, const std::string& who, const std::string& why);

/// As StudyStore::recordUnblinding.
void recordUnblindingIn(const SqliteConnection& sqlite, const UnblindingRecord& record);

}  // namespace database
