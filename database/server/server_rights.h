// What a login can learn from a study on a server, by the rights that the server grants and by trying.
#pragma once

#include <string>
#include <vector>

#include "database/server/server_address.h"

namespace database {

/// PostgreSQL's counters of the blocks that were read, of a table and of the whole database: "pg_stat_get_blocks_hit(oid)".
std::vector<std::string> readCounters();

struct ServerRights {
    std::string study, login;
    std::vector<std::string> roles;  ///< of the study: "experimenter", "monitor", "analyst", "display", "owner"
    std::string imagesTo;            ///< "station" or "display"; empty where the login cannot ask
    std::vector<std::string> may;    ///< functions of the study that the login may call
    /// What neither an experimenter nor a monitor may have: rights on tables, on the server's files, on other functions, or a
    /// presentation that is not due. One line each.
    std::vector<std::string> learns;
    std::vector<std::string> refused;  ///< what was tried and refused, one line each
};

/// Enrols nobody and changes nothing. Throws the errors of ServerConnection.
ServerRights rightsOf(const ServerAddress& address);

}  // namespace database
