#include "study/commands/json_output.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "protocols/files/errors.h"

namespace study::commands {

void addJsonOption(CLI::App& command, JsonTarget& target)
{
    command
        .add_option_function<std::vector<std::string>>(
            "--json", [&target](const std::vector<std::string>& values) { target = values.empty() ? "" : values.front(); },
            "print one JSON object instead of text, or write it to FILE")
        ->expected(0, 1)
        ->type_name("[FILE]")
        ->trigger_on_parse();
}

void writeJson(const JsonTarget& target, const nlohmann::ordered_json& object)
{
    const std::string text = object.dump(2) + "\n";
    if (target->empty())
        std::fputs(text.c_str(), stdout);
    else
        writeFile(*target, text);
}

void writeFile(const std::filesystem::path& file, std::string_view text)
{
    auto temporary = file;
    temporary += ".part" + std::to_string(getpid());
    std::ofstream out(temporary, std::ios::binary);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    std::error_code failure;
    if (out) std::filesystem::rename(temporary, file, failure);
    if (!out || failure) {
        std::filesystem::remove(temporary, failure);
        throw protocols::environmentFault(
            {"cannot be written", file.string(), "a writable folder with free space", "choose another place or free the disk"});
    }
}

std::string readFile(const std::filesystem::path& file)
{
    std::error_code ignored;
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file, ignored))
        throw protocols::badInput({in ? "is a folder" : "cannot be read", file.string(), "a readable file", "check the path"});
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string csvCell(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string numberText(double value)
{
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return std::string(buffer, end);
}

}  // namespace study::commands
