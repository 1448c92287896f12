#include "study/making/own/own_program.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>
#include <sstream>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/utf8.h"

namespace study::making {

namespace {

namespace fs = std::filesystem;

constexpr const char* form = "ID=COMMAND, such as --program \"mine=python3 render.py\"";

protocols::Error badCall(const std::string& text, const std::string& what, const std::string& expected, const std::string& next)
{
    return protocols::badInput({what, "--program " + text, expected, next});
}

std::optional<fs::path> foundProgram(const std::string& name)
{
    std::error_code none;
    if (name.find('/') != std::string::npos)
        return fs::exists(name, none) ? std::optional(fs::absolute(name).lexically_normal()) : std::nullopt;
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const fs::path file = fs::path(folder) / name; !folder.empty() && fs::is_regular_file(file, none))
            return fs::absolute(file).lexically_normal();
    return std::nullopt;
}

fs::path requireProgram(const std::string& name, const std::string& text)
{
    const auto found = foundProgram(name);
    if (!found)
        throw badCall(text, "the program '" + name + "' is missing",
                      name.find('/') == std::string::npos ? "a program in a folder of PATH, or its path" : "an executable file",
                      "correct the command");
    std::error_code none;
    if (!fs::is_regular_file(*found, none) || ::access(found->c_str(), X_OK) != 0)
        throw badCall(text, "'" + found->string() + "' cannot be executed", "an executable file",
                      "run `chmod +x` on it, or put its interpreter in front, such as python3");
    return *found;
}

}  // namespace

std::vector<std::string> wordsOf(std::string_view command)
{
    std::vector<std::string> words;
    bool inWord = false;
    char quote = '\0';
    for (const char c : command) {
        const bool isBlank = c == ' ' || c == '\t';
        if (quote == '\0' && isBlank) {
            inWord = false;
            continue;
        }
        if (!inWord) words.emplace_back();
        inWord = true;
        if (quote == '\0' && (c == '"' || c == '\''))
            quote = c;
        else if (c == quote)
            quote = '\0';
        else
            words.back() += c;
    }
    if (quote != '\0')
        throw protocols::badInput({std::string("a quote ") + quote + " is not closed", std::string(command),
                                   "words, of which those with blanks stand in \"...\"", "close the quote"});
    return words;
}

OwnProgram ownProgramFrom(const std::string& text)
{
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw badCall(text, "names no condition", form, "correct the call");
    if (protocols::firstByteThatIsNotUtf8(text) || text.find('\0') != std::string::npos)
        throw badCall(text, "the command is not UTF-8", form, "rename the files");
    OwnProgram own;
    own.condition = protocols::ConditionId(text.substr(0, equals));
    own.command = text.substr(equals + 1);
    if (const std::string fault = protocols::faultOfOwnId(own.condition.value); !fault.empty())
        throw badCall(text, fault, "the id of a condition that the protocol marks with \"program\": true", "correct the id");
    const std::vector<std::string> words = wordsOf(own.command);
    if (words.empty() || words.front().empty()) throw badCall(text, "names no program", form, "add the command after the =");
    own.program = requireProgram(words.front(), text);
    own.arguments.assign(words.begin() + 1, words.end());
    return own;
}

void requirePrograms(const protocols::Protocol& protocol, const std::vector<OwnProgram>& programs,
                     const std::string& protocolFile)
{
    std::set<protocols::ConditionId> named;
    for (const OwnProgram& own : programs) {
        const std::string& id = own.condition.value;
        const std::string call = id + "=" + own.command;
        if (!named.insert(own.condition).second)
            throw badCall(call, "condition '" + id + "' has two programs", "one --program for each condition",
                          "leave one of them out");
        if (protocol.ownImages.contains(own.condition))
            throw badCall(call, "condition '" + id + "' has ready images in " + protocolFile,
                          "a condition with \"program\": true", "leave --program out, or change the protocol");
        if (!protocol.ownPrograms.contains(own.condition))
            throw badCall(call, protocolFile + " has no condition '" + id + "'",
                          "a condition {\"id\": \"" + id + "\", \"program\": true}", "correct the id, or add the condition");
    }
    for (const protocols::ConditionId& id : protocol.ownPrograms)
        if (!named.contains(id))
            throw protocols::badInput({"condition '" + id.value + "' comes from a program, and none is named", protocolFile,
                                       "`vis2hap study new --program " + id.value + "=COMMAND`", "add it to the call"});
}

}  // namespace study::making
