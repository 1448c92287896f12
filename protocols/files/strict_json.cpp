#include "protocols/files/strict_json.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <system_error>
#include <vector>

#include "protocols/files/errors.h"

namespace protocols {

namespace {

std::string placeOf(std::string_view text, std::size_t offset)
{
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t lastBreak = before.rfind('\n');
    const std::size_t column = lastBreak == std::string_view::npos ? before.size() + 1 : before.size() - lastBreak;
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// Length of the well-formed UTF-8 sequence at the front of `text` (RFC 3629), or 0.
std::size_t sequenceLength(std::string_view text)
{
    const auto at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const auto continues = [&](std::size_t i) { return (at(i) & 0xC0u) == 0x80u; };
    const unsigned lead = at(0);
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead <= 0xDF) return continues(1) ? 2 : 0;
    if (lead >= 0xE0 && lead <= 0xEF) {
        const bool overlong = lead == 0xE0 && at(1) < 0xA0;
        const bool surrogate = lead == 0xED && at(1) > 0x9F;
        return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
    }
    if (lead >= 0xF0 && lead <= 0xF4) {
        const bool overlong = lead == 0xF0 && at(1) < 0x90;
        const bool beyond = lead == 0xF4 && at(1) > 0x8F;
        return continues(1) && continues(2) && continues(3) && !overlong && !beyond ? 4 : 0;
    }
    return 0;
}

std::optional<std::size_t> firstByteThatIsNotUtf8(std::string_view text)
{
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = sequenceLength(text.substr(i));
        if (length == 0) return i;
        i += length;
    }
    return std::nullopt;
}

/// "[json.exception.parse_error.101] parse error at line 2, column 1: syntax error ..." without its label.
std::string withoutLabel(std::string message)
{
    const std::size_t end = message.find("] ");
    return message.starts_with('[') && end != std::string::npos ? message.substr(end + 2) : message;
}

}  // namespace

nlohmann::json parseStrictJson(std::string_view text, const std::string& where)
{
    if (const auto offset = firstByteThatIsNotUtf8(text))
        throw badInput({.what = "the text is not UTF-8 at " + placeOf(text, *offset),
                        .where = where,
                        .expected = "JSON in UTF-8",
                        .nextStep = "save the file in UTF-8"});
    std::vector<std::set<std::string>> keysOfOpenObjects;
    std::vector<std::string> doubled;
    const nlohmann::json::parser_callback_t noteKeys = [&](int, nlohmann::json::parse_event_t event, nlohmann::json& value) {
        using Event = nlohmann::json::parse_event_t;
        if (event == Event::object_start) keysOfOpenObjects.emplace_back();
        if (event == Event::object_end) keysOfOpenObjects.pop_back();
        if (event == Event::key && !keysOfOpenObjects.back().insert(value.get<std::string>()).second)
            doubled.push_back("'" + value.get<std::string>() + "'");
        return true;
    };
    nlohmann::json parsed;
    try {
        parsed = nlohmann::json::parse(text.begin(), text.end(), noteKeys);
    } catch (const nlohmann::json::exception& fault) {
        throw badInput({.what = withoutLabel(fault.what()),
                        .where = where,
                        .expected = "well-formed JSON",
                        .nextStep = "correct the text at that place"});
    }
    if (doubled.empty()) return parsed;
    std::string names;
    for (const std::string& key : doubled) names += (names.empty() ? "" : ", ") + key;
    throw badInput({.what = "doubled key " + names,
                    .where = where,
                    .expected = "each key once in its object",
                    .nextStep = "remove one of the two"});
}

std::string readTextFile(const std::filesystem::path& file)
{
    std::error_code ignored;
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file, ignored))
        throw badInput({.what = std::string("cannot be read (") + std::strerror(stream ? EISDIR : errno) + ")",
                        .where = file.string(),
                        .expected = "a readable file",
                        .nextStep = "check the path and its permissions"});
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace protocols
