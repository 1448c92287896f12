// Reads what study.db holds, each kind of row as its value.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "database/response_columns.h"
#include "database/sqlite_connection.h"
#include "database/study_store.h"

namespace database {

StudyFacts factsIn(const SqliteConnection& sqlite);
/// [slot]; empty where the pieces have no codes. Throws workFailed where a code is in no slot, or is missing.
std::vector<protocols::SwatchLabels> swatchesIn(const SqliteConnection& sqlite, const std::vector<protocols::FabricId>& fabrics);
std::map<protocols::FileCode, std::string> stimulusHashesIn(const SqliteConnection& sqlite);
std::vector<Slot> slotsIn(const SqliteConnection& sqlite);
std::vector<protocols::BlindedTrial> trialsIn(const SqliteConnection& sqlite, int slot);
std::vector<Enrolment> enrolmentsIn(const SqliteConnection& sqlite);  ///< by slot, in each by time
std::vector<ProtocolVersion> protocolVersionsIn(const SqliteConnection& sqlite);
std::vector<EventRecord> eventsIn(const SqliteConnection& sqlite, const protocols::ParticipantId& participant);
std::vector<EventRecord> eventsOfKindIn(const SqliteConnection& connection, const std::string& kind);
std::optional<std::int64_t> firstEventOfKindIn(const SqliteConnection& connection, const std::string& kind);
/// By slot, trial and question.
void eachAnswerIn(const SqliteConnection& sqlite, const std::function<void(CurrentAnswer)>& take);
std::vector<StudyStore::Flag> flagsIn(const SqliteConnection& sqlite);
std::optional<UnblindingRecord> unblindingIn(const SqliteConnection& sqlite);
/// The answer of a row; its note is empty. `alternatives`: those of the row, read.
AnswerRecord answerRecordOf(const ResponseRow& row, std::vector<protocols::FabricId> alternatives);
/// s. Of stamps that are further apart than 64 bits can count, in an altered study, the largest difference that they can.
double secondsBetween(std::int64_t fromNs, std::int64_t toNs);
/// From the touch to the beginning of the answer, s; none where a stamp is missing. A script states one time, so without a touch
/// its time runs from the question.
std::optional<double> responseSecondsOf(const ResponseRow& row);
std::optional<double> responseSecondsOf(const AnswerRecord& record);
/// From the touch to the entry of the answer, s; from the question where no touch was stamped.
double secondsOf(const AnswerRecord& record);
LogHead headIn(const SqliteConnection& sqlite);
std::vector<Erasure> erasuresIn(const SqliteConnection& sqlite);
std::map<protocols::ParticipantId, std::map<std::string, std::string>> personalFactsIn(const SqliteConnection& sqlite);
std::map<protocols::ParticipantId, int> voidedPresentationsIn(const SqliteConnection& sqlite);

}  // namespace database
