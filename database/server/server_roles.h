// Who may do what with a study on a server, and the folder of a station.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "database/server/server_address.h"

namespace database {

/// Makes the study's roles where they are missing, and grants them. `logins`: login and role ("experimenter", "monitor",
/// "analyst" or "display"). Returns one line for each role. Throws badInput for an unknown role or login, and without the right
/// to make roles.
std::vector<std::string> makeRoles(const ServerAddress& address, const std::vector<std::pair<std::string, std::string>>& logins);

/// Where the images of presentations go: "station", or "display" with tickets for the stations. Only the owner may call it.
/// Throws workFailed while a station is connected.
void giveImagesTo(const ServerAddress& address, const std::string& place);

struct JoinedStudy {
    std::filesystem::path folder;
    std::string name, station;
};
/// Makes the folder of a station: its note, and the protocol. An empty `folder` becomes the name of the study. Throws badInput
/// where the folder is not empty, and for a login without the role.
JoinedStudy joinStudy(const ServerAddress& address, const std::filesystem::path& folder, const std::string& station);

}  // namespace database
