// What the commands for a study on a server do. Each function prints what it did and returns the exit code.
#pragma once

#include <string>
#include <vector>

#include "study/commands/parts/json_output.h"

namespace study::commands {

/// Between a folder and an address, in either direction. `station`: the owner's name among the stations; empty: the computer's.
/// `givenUp`: stations that are away, whose answers may be lost on the way back.
int moveStudy(const std::string& from, const std::string& to, const std::string& station,
              const std::vector<std::string>& givenUp);

/// Moves a study that was just made in `folder` to the address.
int moveNewStudy(const std::string& folder, const std::string& address);

/// The folder in which the files of a new study at this address are made: the study's name, in the present folder. Throws
/// badInput where the address names no study, or one that the server has already.
std::string folderOfNewStudy(const std::string& address);

/// Makes the folder of a station. A folder that is one takes the address.
int joinAsStation(const std::string& address, const std::string& folder, const std::string& station);

/// `grants`: LOGIN=ROLE. `imagesTo`: "station" or "display"; empty: as it is. `releasesHeld`: gives out again what the server
/// holds back until the owner has looked (database/server/server_roles.h).
int grantRoles(const std::string& address, const std::vector<std::string>& grants, const std::string& imagesTo,
               bool releasesHeld);

/// Progress and stations.
int showServer(const std::string& address);

/// leak-check of an address: what the login can learn. 0 where it has no more than a station or a monitor may have.
int checkLogin(const std::string& address, const JsonTarget& target);

}  // namespace study::commands
