// A protocol file: JSON checked against protocol.schema.json (built into the program) and then
// against the rules that a schema cannot say (protocol.h, faultsOf).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "protocols/protocol.h"

namespace protocols {

/// `where` names the source in errors. Throws badInput listing every fault in one line.
Protocol protocolFromJson(std::string_view json, const std::string& where);
Protocol readProtocol(const std::filesystem::path& file);

/// The paper's study, 7 fabrics x 9 conditions x 10 participants: the shipped protocols/vis2hap.json,
/// built into the program, and its text (what a study folder keeps and hashes).
std::string_view paperProtocolJson();

}  // namespace protocols
