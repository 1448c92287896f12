// Who may do what with a study on a server, and the folder of a station.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "database/disk/study_folder.h"
#include "database/server/server_address.h"

namespace database {

/// Makes the study's roles where they are missing, and grants them. `logins`: login and role ("experimenter", "monitor",
/// "analyst" or "display"). Called by the owner, it also gives the study the functions of this program. Returns one line for each
/// role. Throws badInput for an unknown role or login, without the right to make roles, and for tables of an earlier version.
std::vector<std::string> makeRoles(const ServerAddress& address, const std::vector<std::pair<std::string, std::string>>& logins);

/// Where the images of presentations go: "station", or "display" with tickets for the stations. Only the owner may call it.
/// Throws workFailed while a station is connected.
void giveImagesTo(const ServerAddress& address, const std::string& place);

/// Takes from all logins the counters of PostgreSQL that tell how many blocks of a table were read: images that look alike to the
/// rights of a study do not look alike to these. Returns the SQL commands that this login may not give; a superuser of the
/// server must run them in the database.
std::vector<std::string> closeReadCounters(const ServerAddress& address);

/// Lets go on what the server holds back until the owner has looked: slots of participants who withdrew at a station, and the
/// next presentation after three voids in a row. Returns one line for each participant concerned. Only the owner may call it.
std::vector<std::string> releaseHeld(const ServerAddress& address);

/// Keeps statements of the database out of the server's log, for connections made from now on: a refused one would put answers,
/// notes and facts there. Returns the SQL commands that this login may not give; a superuser of the server must run them.
std::vector<std::string> keepLogQuiet(const ServerAddress& address);

struct JoinedStudy {
    std::filesystem::path folder;
    std::string name, station;
};
/// Makes the folder of a station: its note, and the protocol. An empty `folder` becomes the name of the study. Throws badInput
/// where the folder is not empty, and for a login without the role.
JoinedStudy joinStudy(const ServerAddress& address, const std::filesystem::path& folder, const std::string& station);

}  // namespace database
