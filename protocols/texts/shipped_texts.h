// The JSON files of protocols/ and protocols/examples/, built into the program.
#pragma once

#include <span>
#include <string_view>

namespace protocols::shipped {

std::string_view protocolSchema();  ///< protocol.schema.json
std::string_view paperProtocol();   ///< vis2hap.json

/// A protocol of protocols/examples.
struct Example {
    std::string_view name;  ///< of its file, without ".json"
    std::string_view text;
};
/// All of them, those that are explained first come first.
std::span<const Example> examples();

}  // namespace protocols::shipped
