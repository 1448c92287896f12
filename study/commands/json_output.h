// The option `--json [FILE]`: one JSON object, in a file or alone on standard output.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace study::commands {

/// None: text for people. Empty: standard output. Otherwise the name of a file.
using JsonTarget = std::optional<std::string>;

/// Adds the option; `target` must live until the line is parsed.
void addJsonOption(CLI::App& command, JsonTarget& target);

void writeJson(const JsonTarget& target, const nlohmann::ordered_json& object);

/// Whole file, written beside it and renamed. Throws environmentFault.
void writeFile(const std::filesystem::path& file, std::string_view text);

/// Throws badInput where it cannot be read.
std::string readFile(const std::filesystem::path& file);

/// One CSV cell by RFC 4180.
std::string csvCell(const std::string& text);

/// The shortest text that reads back exactly.
std::string numberText(double value);

}  // namespace study::commands
