#include "study/participant/page_lines.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/files/safe_text.h"
#include "protocols/files/strict_json.h"

namespace study::participant {

namespace {

using nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr const char* appLine = "a line of the app";
constexpr const char* pageLine = "a line of vis2hap-page";

protocols::Error refusedLine(const std::string& what, const char* where) { return protocols::badInput({what, where, "", ""}); }

std::string inOneLine(const OrderedJson& line) { return line.dump(-1, ' ', false, json::error_handler_t::replace); }

json objectIn(std::string_view text, const char* where)
{
    if (text.size() > longestLine) throw refusedLine("this line is too long", where);
    json line = protocols::parseStrictJson(text, where);
    if (!line.is_object()) throw refusedLine("this is no JSON object", where);
    return line;
}

std::string textIn(const json& object, const char* key, const char* where)
{
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end() || !found->is_string())
        throw refusedLine(std::string("'") + key + "' is no text", where);
    return found->get<std::string>();
}

int countIn(const json& object, const char* key, int largest, const char* where)
{
    const auto found = object.is_object() ? object.find(key) : object.end();
    const bool isCount = object.is_object() && found != object.end() && found->is_number_unsigned() &&
                         found->get<std::uint64_t>() <= static_cast<std::uint64_t>(largest);
    if (!isCount) throw refusedLine(std::string("'") + key + "' is no whole number to " + std::to_string(largest), where);
    return found->get<int>();
}

/// The address of a browser, which the app shows.
std::string addressIn(const json& object)
{
    const std::string from = textIn(object, "from", pageLine);
    constexpr std::size_t longestAddress = 100;
    if (from.size() > longestAddress || protocols::printable(from) != from) throw refusedLine("'from' is no address", pageLine);
    return from;
}

/// Empty, or SHA-256 in hexadecimal.
std::string hashIn(const json& object, const char* key, const char* where)
{
    const std::string hash = textIn(object, key, where);
    const bool isHash = hash.size() == 64 && hash.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!isHash) throw refusedLine(std::string("'") + key + "' is no hash", where);
    return hash;
}

std::string codeIn(const json& object)
{
    const std::string code = textIn(object, "code", appLine);
    constexpr std::size_t longestCode = 20;
    if (code.empty() || code.size() > longestCode) throw refusedLine("'code' has no length from 1 to 20", appLine);
    return code;
}

PageTexts textsIn(const json& object)
{
    PageTexts texts{textIn(object, "language", appLine), {}};
    const auto found = object.find("texts");
    if (found == object.end() || !found->is_object()) throw refusedLine("'texts' is no object", appLine);
    for (const auto& [key, text] : found->items()) texts.texts[key] = textIn(*found, key.c_str(), appLine);
    return texts;
}

}  // namespace

std::string lineOf(const LineToPage& line)
{
    return std::visit(
        protocols::Overloaded{
            [](const NewCode& code) {
                return inOneLine({{"code", code.code}});
            },
            [](const KnownDevice& device) {
                return inOneLine({{"session", device.sessionHash}});
            },
            [](const PageTexts& texts) {
                return inOneLine({{"language", texts.language}, {"texts", texts.texts}});
            },
            [](const NumberedInstruction& present) {
                return inOneLine({{"number", present.number}, {"instruction", OrderedJson::parse(jsonOf(present.instruction))}});
            }},
        line);
}

LineToPage lineToPage(std::string_view text)
{
    const json line = objectIn(text, appLine);
    if (line.contains("code")) return NewCode{codeIn(line)};
    if (line.contains("session")) return KnownDevice{hashIn(line, "session", appLine)};
    if (line.contains("texts")) return textsIn(line);
    if (!line.contains("instruction")) throw refusedLine("this line says nothing that the page knows", appLine);
    return NumberedInstruction{countIn(line, "number", 1'000'000'000, appLine),
                               instructionFromJson(line.at("instruction").dump(), appLine)};
}

std::string lineOf(const LineFromPage& line)
{
    return std::visit(protocols::Overloaded{
                          [](const Listening& listening) {
                              return inOneLine({{"listening", listening.port}});
                          },
                          [](const DeviceEntered& device) {
                              return inOneLine({{"entered", device.sessionHash}, {"from", device.from}});
                          },
                          [](const WrongCodeEntered& wrong) {
                              return inOneLine({{"wrong_codes", wrong.tries}, {"is_void", wrong.isVoid}, {"from", wrong.from}});
                          },
                          [](const DeviceRefused& device) {
                              return inOneLine({{"refused", true}, {"from", device.from}});
                          },
                          [](const ParticipantAct& act) {
                              return inOneLine({{"act", OrderedJson::parse(jsonOf(act))}});
                          }},
                      line);
}

LineFromPage lineFromPage(std::string_view text)
{
    const json line = objectIn(text, pageLine);
    if (line.contains("act")) return actFromJson(line.at("act").dump(), pageLine);
    if (line.contains("listening")) return Listening{countIn(line, "listening", 65535, pageLine)};
    if (line.contains("entered")) return DeviceEntered{addressIn(line), hashIn(line, "entered", pageLine)};
    if (line.contains("refused")) return DeviceRefused{addressIn(line)};
    if (!line.contains("wrong_codes")) throw refusedLine("this line says nothing that the app knows", pageLine);
    if (!line.contains("is_void") || !line.at("is_void").is_boolean()) throw refusedLine("'is_void' is missing", pageLine);
    return WrongCodeEntered{addressIn(line), countIn(line, "wrong_codes", 1'000'000, pageLine), line.at("is_void").get<bool>()};
}

std::vector<std::string> LineBuffer::take(std::string_view bytes)
{
    std::vector<std::string> lines;
    for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n')) {
        lines.push_back(std::exchange(m_begun, {}) + std::string(bytes.substr(0, end)));
        bytes.remove_prefix(end + 1);
    }
    m_begun += bytes;
    const auto isTooLong = [](const std::string& line) { return line.size() > longestLine; };
    if (isTooLong(m_begun) || std::ranges::any_of(lines, isTooLong)) {
        m_begun.clear();
        throw refusedLine("a line is longer than " + std::to_string(longestLine) + " bytes", "lines of app and page");
    }
    return lines;
}

}  // namespace study::participant
