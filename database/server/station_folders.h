// The folders of this computer that are stations of studies on servers. A study is the same by what it is (identityOf()), not by
// how its address is spelt: entries that wait in a folder must follow their study to another host, port or database.
#pragma once

#include <filesystem>
#include <string>

#include "database/disk/study_folder.h"
#include "database/server/server_address.h"

namespace database {

/// Number of entries that wait in the folder of a station. Throws environmentFault where a program has it open.
std::size_t entriesWaiting(const StudyFolder& folder);

/// Writes another address of the same study into the note of a station's folder, after the server has let the station in by it.
/// Entries that wait there are sent when the folder is opened. Throws badInput where the server has another study there, and
/// where entries wait in a folder from an earlier version whose study cannot be known.
void takeAddress(const ServerAddress& address, const StudyFolder& folder);

/// The folder of this station for the address, below `stations`. A folder of the same study takes the address; a new one, with
/// the station's name `station`, is made where there is none. What waits in further folders of the study is sent at once. Throws
/// the errors of takeAddress(), joinStudy() and StationStore, and workFailed where the server refuses what waited in a further
/// folder.
std::filesystem::path stationFolder(const ServerAddress& address, const std::filesystem::path& stations,
                                    const std::string& station);

}  // namespace database
