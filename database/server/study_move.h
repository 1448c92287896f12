// A study on its way between its folder and a server. Both ways end with a comparison of all rows, and a move that is interrupted
// at any point is completed by the same call.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "database/evidence/acts.h"
#include "database/server/server_address.h"
#include "database/study_store.h"
#include "protocols/files/temporary_folder.h"

namespace database {

/// Sends study.db and the images to the server, and leaves server.json in its place; keys, protocol and stimuli stay in the
/// folder. `station`: the name of this folder among the study's stations. Throws badInput where this database or another one of
/// the server has a study of this name, and for a folder that lies on a server already. Returns the head of the log.
LogHead moveToServer(const StudyFolder& folder, const ServerAddress& address, const std::string& station);

/// Throws badInput where this database or another one of the server has a study of this name, and the errors of ServerConnection:
/// before a study is made for it.
void requireFreeName(const ServerAddress& address);

/// Brings the study back into its owner's folder and takes it off the server. Throws workFailed while a station is at work.
/// `by`: who moved it, with which program, on which machine; recorded as a serverAct where it names a program.
/// `givenUp`: stations that are away, whose answers may be lost; others that hold a participant or may owe entries are refused.
LogHead moveToFolder(const ServerAddress& address, const StudyFolder& folder, const Act& by = {},
                     const std::vector<std::string>& givenUp = {});

/// The commands that remove what a study left in the files of a server, for an administrator of it; one a line, indented.
extern const char* const removalFromServer;

/// The study as it stands now, wherever it lies. Of a study on a server this reads a copy of rows and files, which its owner's
/// folder gives the right to.
StudyStore readStudy(const StudyFolder& folder);

/// The rows of a study on a server as they stand now: a folder with study.db alone, without keys and images. `folder`: of the
/// study's owner.
std::unique_ptr<protocols::TemporaryFolder> fetchedRows(const StudyFolder& folder);

/// Records what was done with the study in the server's chain of acts. Returns why it could not be recorded, or nothing.
std::optional<std::string> recordActOnServer(const StudyFolder& folder, Act act);

}  // namespace database
