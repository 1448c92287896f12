// The JSON files of this folder, built into the program.
#pragma once

#include <string_view>

namespace protocols::shipped {

std::string_view protocolSchema();  ///< protocol.schema.json
std::string_view paperProtocol();   ///< vis2hap.json

}  // namespace protocols::shipped
