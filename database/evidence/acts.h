// What was done with a study outside its sessions: exports, backups, reports, unblindings. The acts have a hash chain of their
// own (table acts). A short transaction writes them without the lock of the session, so an export during a session is recorded,
// too. Each act names the head of the log at that time. A log that was chained anew without the acts disagrees with them. Later
// entries of the log name the last act (event_chain.h), so acts that lie before a known head cannot be cut off.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "database/event_chain.h"
#include "database/study_store.h"

namespace database {

/// The act of a study that came back from a server, whose log, write-ahead log and backups may hold what it had until then.
constexpr const char* serverAct = "server";

struct Act {
    std::string kind;                ///< "export", "backup", "report", "unblind", "leak-check", "sign", personExport
    std::string who, program, host;  ///< account or --operator, program version, machine
    std::string path;                ///< what was written; empty if nothing
    LogHead head;                    ///< of the log at that time
    std::string wallTime;            ///< set by recordAct where it is empty
    std::string note = {};           ///< what the act found wrong, or whose data it handed over; empty for most acts
};

/// Kind of the act that hands the data of one person over; its note is the code of the participant.
inline constexpr const char* personExport = "export of one person";

/// The JSON of an act in its chain.
std::string detailsOf(const Act& act);

/// Returns why the act could not be recorded (a read-only folder, a locked database, a share on which another computer writes),
/// or nothing. Never throws for that, because the act itself is done.
std::optional<std::string> recordAct(const StudyFolder& folder, Act act);

/// In the order in which they were done. An act that cannot be read has no head, and says so in its path and its note.
std::vector<Act> actsOf(const StudyStore& store);

/// Every act in its order, also where its details cannot be read.
std::vector<ChainedAct> chainedActsOf(const StudyStore& store);

/// Number and hash of the last act, which commits to every act before it; empty where there is none.
LogHead headOfActs(const StudyStore& store);

/// The exports, backups, reports and stays on a server that were recorded when the log had entry `sequence`: they may hold its
/// content. `about`: without exports of the data of other people; empty: with all.
std::vector<Act> copiesSince(const StudyStore& store, std::int64_t sequence, const protocols::ParticipantId& about = {});

/// One line for each fault of the chain, and for each act whose head is not in the log.
std::vector<std::string> faultsOfActs(const StudyStore& store);

}  // namespace database
