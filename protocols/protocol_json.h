// Reads a protocol file: JSON that is checked against protocol.schema.json (built into the program) and against the rules that
// a schema cannot express (protocol.h, question_ids.h). All faults of a file stand in one list.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "protocols/protocol.h"

namespace protocols {

/// `where` names the source in errors. Throws badInput listing every fault in one line.
Protocol protocolFromJson(std::string_view json, const std::string& where);
Protocol readProtocol(const std::filesystem::path& file);

/// The protocol that an existing study keeps. The rules for question ids (question_ids.h) are younger than some studies, so
/// they are not applied.
Protocol keptProtocolFromJson(std::string_view json, const std::string& where);

/// The text of the paper's study, 7 fabrics x 9 conditions x 10 participants: the shipped protocols/vis2hap.json as it is built
/// into the program. A study folder keeps this text and its hash.
std::string_view paperProtocolJson();

}  // namespace protocols
