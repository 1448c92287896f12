// What the log says about participants, protocols, facts and erasures, compared with the tables that hold them outside the log.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "database/event_chain.h"
#include "database/row_audit.h"
#include "database/sqlite_connection.h"

namespace database {

using Log = std::map<std::int64_t, LogEntry>;  ///< by sequence number

/// One line for each difference.
struct StateFaults {
    std::vector<std::string> ofActs;   ///< of participants, protocols and erasures
    std::vector<std::string> ofFacts;  ///< what a login of a server's station may cause by a payload of its own making
};
StateFaults faultsOfStates(const SqliteConnection& sqlite, const Log& log);

/// Entries of the log name the last act of their time. The chain of acts itself does not show that its end was cut off. A login
/// of a server's station may invent such a name, so these faults do not keep a study on its server.
std::vector<std::string> faultsOfNamedActs(const SqliteConnection& sqlite, const Log& log);

/// By question, from all versions of the protocol. Lacks a question that has two kinds, and is empty where a version cannot be
/// read.
TellingFields fieldsOfAnswers(const SqliteConnection& sqlite);

/// Answers that their questions and presentations cannot have, and sessions that ended without some.
std::vector<std::string> faultsOfAnswers(const SqliteConnection& sqlite);

}  // namespace database
