// `--json [FILE]`: one JSON object to a file, or alone on standard output.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace study::commands {

/// Absent: text for people. Present and empty: standard output. Else a file.
using JsonTarget = std::optional<std::string>;

/// Adds the option; `target` must outlive the parse.
void addJsonOption(CLI::App& command, JsonTarget& target);

void writeJson(const JsonTarget& target, const nlohmann::ordered_json& object);

}  // namespace study::commands
