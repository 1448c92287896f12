// The option `--json [FILE]`: one JSON object, in a file or alone on standard output.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace study::commands {

/// None: text for people. Empty: standard output. Otherwise the name of a file.
using JsonTarget = std::optional<std::string>;

/// Adds the option; `target` must live until the line is parsed.
void addJsonOption(CLI::App& command, JsonTarget& target);

void writeJson(const JsonTarget& target, const nlohmann::ordered_json& object);

}  // namespace study::commands
