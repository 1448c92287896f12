// The recordings for the participant's headphones: read beside the protocol, checked, and copied into the study with their
// hashes.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "database/disk/study_folder.h"
#include "protocols/protocol.h"

namespace study::making {

/// Bytes of each recording by its key. `protocolFile`: the recordings lie beside it. Throws badInput for a file that is missing
/// or that cannot be played.
std::map<std::string, std::string> readPrompts(const protocols::Protocol& protocol, const std::filesystem::path& protocolFile);

/// Writes them into the folder of a study that is being made. Throws environmentFault on faults of the disk.
void writePrompts(const database::StudyFolder& folder, const std::map<std::string, std::string>& prompts);

}  // namespace study::making
