// The note in the folder of a study that lies on a server (server.json): its address, and the name of this station. The folder of
// the study's owner keeps keys, protocol and stimuli beside it; the folder of a station that joined holds only its queue.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace database {

struct ServerNote {
    std::string address;
    std::string station;        ///< name of this station in the study
    std::string token;          ///< proves that a new connection is the same station, 64 hexadecimal digits
    bool isOwner = false;       ///< the folder has the study's keys
    std::string computer = {};  ///< hash of the computer that last used the note; empty: not known
    std::string study = {};     ///< identityOf() the study; empty before the first connection
};

/// `folder`: of the study.
void writeServerNote(const std::filesystem::path& folder, const ServerNote& note);
/// None where the study lies in the folder. Throws badInput for a note that cannot be read.
std::optional<ServerNote> readServerNote(const std::filesystem::path& folder);
/// SHA-256 of what names this computer: its machine id and host name. A copied disk has the same machine id.
std::string hashOfThisComputer();
/// server.json
std::filesystem::path serverNoteOf(const std::filesystem::path& folder);

}  // namespace database
