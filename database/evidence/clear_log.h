// What exports show of the log: the clear part of each entry, which the hash chain covers. Payload, stamps of answers and salts
// are not among it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "database/study_store.h"

namespace database {

/// The clear part of an entry and its links. The chain covers the time only through the commitment.
struct ClearEntry {
    std::int64_t sequence = 0;
    std::string participant;  ///< empty for acts on the study itself
    int sitting = 0;
    std::string kind, wallTime;                      ///< the time is empty where the entry was erased
    std::string places, commitment, previous, hash;  ///< as in event_chain.h
};

/// Calls `take` with every entry in its order, from one state of the database. Returns the head of that state.
LogHead eachClearEntry(const StudyStore& store, const std::function<void(const ClearEntry&)>& take);

/// An answer as it was given: the first to its question, or a correction. Voided presentations are included.
struct LoggedAnswer {
    std::int64_t event = 0;  ///< entry of the log
    int sitting = 0, attempt = 1;
    bool voided = false;
    std::string wallTime;
    std::optional<double> responseSeconds;  ///< touch to answer begun; none where a stamp is missing
    AnswerRecord record;                    ///< its note is empty
};
/// Every answer of the participant, in the order in which they were given.
std::vector<LoggedAnswer> answersGivenBy(const StudyStore& store, const protocols::ParticipantId& participant);

/// What the operator wrote down during a presentation.
struct LoggedNote {
    std::int64_t event = 0;
    int trial = 0, attempt = 1;
    std::string question;  ///< empty where the note concerns the whole presentation
    std::string text;
    bool isFlag = false;
    std::string wallTime;
};
std::vector<LoggedNote> notesAbout(const StudyStore& store, const protocols::ParticipantId& participant);

}  // namespace database
