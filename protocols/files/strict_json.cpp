#include "protocols/files/strict_json.h"

#include <algorithm>
#include <forward_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "protocols/files/json_in_order.h"
#include "protocols/files/utf8.h"

namespace protocols {

namespace {

/// Doubled keys that a message names with their places.
constexpr std::size_t mostDoubledKeysShown = 10;
constexpr std::size_t longestKeyShown = 100, longestReasonShown = 300;  // bytes

TextPlace textPlaceOfByte(std::string_view text, std::size_t offset)
{
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto lines = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
    const std::string_view inLine = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0: the first line
    const auto characters = std::count_if(inLine.begin(), inLine.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return {lines + 1, static_cast<std::size_t>(characters) + 1};
}

/// "line 3, column 5" of a byte.
std::string placeOfByte(std::string_view text, std::size_t offset)
{
    const TextPlace place = textPlaceOfByte(text, offset);
    return "line " + std::to_string(place.line) + ", column " + std::to_string(place.column);
}

/// The reason in "[json.exception.parse_error.101] parse error at line 2, column 1: syntax error ...".
std::string reasonIn(std::string message)
{
    if (const std::size_t label = message.find("] "); message.starts_with('[') && label != std::string::npos)
        message.erase(0, label + 2);
    if (const std::size_t place = message.find(": "); message.starts_with("parse error") && place != std::string::npos)
        message.erase(0, place + 2);
    return message;
}

/// The number in "... number overflow parsing '1e999'".
std::string quotedIn(const std::string& message)
{
    const std::size_t end = message.rfind('\''), begin = message.find('\'');
    return begin < end && end != std::string::npos ? message.substr(begin + 1, end - begin - 1) : "";
}

/// Steps through a well-formed text. Nothing here is recursive, because a text may nest to any depth.
class Cursor {
public:
    explicit Cursor(std::string_view text) : m_text(text) { skipBlanks(); }

    std::size_t at() const { return m_at; }
    bool isAtEnd() const { return m_at >= m_text.size(); }
    char letter() const { return m_at < m_text.size() ? m_text[m_at] : '\0'; }

    void skipLetter() { ++m_at; }

    void skipBlanks()
    {
        while (isBlank(letter())) ++m_at;
    }

    /// Returns the text in the quotes, decoded.
    std::string readString()
    {
        const std::string_view quoted = readQuoted();
        if (quoted.find('\\') == std::string_view::npos) return std::string(quoted.substr(1, quoted.size() - 2));
        return nlohmann::json::parse(quoted).get<std::string>();
    }

    /// Returns the text with its quotes, as it stands.
    std::string_view readQuoted()
    {
        const std::size_t from = m_at;
        skipString();
        return m_text.substr(from, m_at - from);
    }

    void skipString()
    {
        for (++m_at; letter() != '"'; ++m_at)
            if (letter() == '\\') ++m_at;
        ++m_at;
    }

    void skipValue()
    {
        std::size_t depth = 0;
        do {
            if (letter() == '"') {
                skipString();
                continue;
            }
            if (letter() == '{' || letter() == '[') ++depth;
            if (letter() == '}' || letter() == ']') --depth;
            ++m_at;
        } while (!isAtEnd() && (depth > 0 || !endsValue(letter())));
    }

private:
    static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
    static bool endsValue(char c) { return isBlank(c) || c == ',' || c == '}' || c == ']'; }

    std::string_view m_text;
    std::size_t m_at = 0;
};

void skipValueAndComma(Cursor& cursor)
{
    cursor.skipValue();
    cursor.skipBlanks();
    if (cursor.letter() == ',') cursor.skipLetter();
    cursor.skipBlanks();
}

/// Moves from the brace of an object to the value of a key. False where there is none.
bool enterMember(Cursor& cursor, const std::string& key)
{
    cursor.skipLetter();
    cursor.skipBlanks();
    while (cursor.letter() == '"') {
        const std::string name = cursor.readString();
        cursor.skipBlanks();
        cursor.skipLetter();  // the colon
        cursor.skipBlanks();
        if (name == key) return true;
        skipValueAndComma(cursor);
    }
    return false;
}

bool enterElement(Cursor& cursor, const std::string& index)
{
    cursor.skipLetter();
    cursor.skipBlanks();
    for (std::size_t i = 0; !cursor.isAtEnd() && cursor.letter() != ']'; ++i) {
        if (std::to_string(i) == index) return true;
        skipValueAndComma(cursor);
    }
    return false;
}

/// Where the value begins that the steps lead to, or the innermost one on the way to it.
std::size_t beginOf(std::string_view text, const std::vector<std::string>& steps)
{
    Cursor cursor(text);
    std::size_t begin = cursor.at();
    for (const std::string& step : steps) {
        const char kind = cursor.letter();
        if (!(kind == '{' ? enterMember(cursor, step) : kind == '[' && enterElement(cursor, step))) break;
        begin = cursor.at();
    }
    return begin;
}

/// The keys of an object so far. Those without escapes are not copied: an object may have millions of them.
class KeysSoFar {
public:
    KeysSoFar() = default;
    KeysSoFar(KeysSoFar&&) = default;
    KeysSoFar& operator=(KeysSoFar&&) = default;
    KeysSoFar(const KeysSoFar&) = delete;  // the keys of a copy would lie in the original
    KeysSoFar& operator=(const KeysSoFar&) = delete;

    /// False where the object has the key already. `quoted`: the key with its quotes; its text must outlive this value.
    bool add(std::string_view quoted)
    {
        if (quoted.find('\\') == std::string_view::npos) return m_keys.insert(quoted.substr(1, quoted.size() - 2)).second;
        return m_keys.insert(m_decoded.emplace_front(Cursor(quoted).readString())).second;
    }

private:
    std::forward_list<std::string> m_decoded;  // its texts keep their places
    std::set<std::string_view> m_keys;         // not hashed: a text could be made of keys with one hash
};

/// The keys that occur twice in their object. Finding a place takes a walk through the text, so only the first ones have it.
struct DoubledKeys {
    std::vector<std::string> first;  ///< "'key' (line 3, column 5)" of the second occurrence
    std::size_t more = 0;
};

DoubledKeys doubledKeys(std::string_view text)
{
    DoubledKeys doubled;
    std::vector<KeysSoFar> keysOfOpenOnes;
    for (Cursor cursor(text); !cursor.isAtEnd();) {
        const char kind = cursor.letter();
        if (kind == '"') {
            const std::size_t from = cursor.at();
            const std::string_view quoted = cursor.readQuoted();
            cursor.skipBlanks();
            if (cursor.letter() != ':' || keysOfOpenOnes.back().add(quoted)) continue;
            if (doubled.first.size() == mostDoubledKeysShown)
                ++doubled.more;
            else
                doubled.first.push_back("'" + inShort(Cursor(quoted).readString(), longestKeyShown) + "' (" +
                                        placeOfByte(text, from) + ")");
            continue;
        }
        if (kind == '{' || kind == '[') keysOfOpenOnes.emplace_back();
        if (kind == '}' || kind == ']') keysOfOpenOnes.pop_back();
        cursor.skipLetter();
    }
    return doubled;
}

/// Throws badInput for a well-formed text with such keys.
void requireSingleKeys(std::string_view text, const std::string& where)
{
    const DoubledKeys doubled = doubledKeys(text);
    if (doubled.first.empty()) return;
    std::string names;
    for (const std::string& key : doubled.first) names += (names.empty() ? "" : ", ") + key;
    if (doubled.more > 0) names += " and " + std::to_string(doubled.more) + " more";
    throw badInput({.what = "doubled key " + names,
                    .where = where,
                    .expected = "each key once in its object",
                    .nextStep = "remove one of the two"});
}

nlohmann::json readBytes(std::string_view text, const nlohmann::json*) { return nlohmann::json::parse(text.begin(), text.end()); }

nlohmann::ordered_json readBytes(std::string_view text, const nlohmann::ordered_json*) { return jsonInOrder(text); }

/// The first byte at which more than `deepestJson` objects and arrays are open. The text need not be well-formed.
std::optional<std::size_t> firstByteTooDeep(std::string_view text)
{
    std::size_t depth = 0;
    bool isInString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (isInString && c == '\\')
            ++i;
        else if (c == '"')
            isInString = !isInString;
        else if (!isInString && (c == '{' || c == '[') && ++depth > deepestJson)
            return i;
        else if (!isInString && (c == '}' || c == ']') && depth > 0)
            --depth;
    }
    return std::nullopt;
}

std::string_view notTooLarge(std::string_view text, const std::string& where)
{
    if (text.size() > largestJson)
        throw badInput({"has " + std::to_string(text.size()) + " bytes", where,
                        "JSON of at most " + std::to_string(largestJson) + " bytes", "check the path"});
    return text;
}

/// Refuses what the parser would read but should not, or reports in words that mislead.
void requireReadable(std::string_view text, const std::string& where)
{
    const auto placed = [&](std::size_t offset) { return where + ", " + placeOfByte(text, offset); };
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
        throw badInput({"the text holds a zero byte", placed(zero), "JSON in UTF-8", "save the file in UTF-8"});
    if (const auto offset = firstByteThatIsNotUtf8(text))
        throw badInput({"the text is not UTF-8", placed(*offset), "JSON in UTF-8", "save the file in UTF-8"});
    if (const auto offset = firstByteTooDeep(text))
        throw badInput({"the text nests too deeply", placed(*offset),
                        "at most " + std::to_string(deepestJson) + " objects and arrays inside each other",
                        "correct the text at that place"});
}

/// "/phases/0" is "phases" and "0".
std::vector<std::string> stepsOf(std::string_view pointer)
{
    std::vector<std::string> steps;
    while (pointer.starts_with('/')) {
        pointer.remove_prefix(1);
        const std::size_t end = std::min(pointer.find('/'), pointer.size());
        std::string step(pointer.substr(0, end));
        // In this order: "~01" means "~1".
        for (const auto& [code, letter] : {std::pair("~1", "/"), std::pair("~0", "~")})
            for (std::size_t at = step.find(code); at != std::string::npos; at = step.find(code, at + 1))
                step.replace(at, 2, letter);
        steps.push_back(std::move(step));
        pointer.remove_prefix(end);
    }
    return steps;
}

template <class Json>
Json parsed(std::string_view text, const std::string& where)
{
    text = withoutByteOrderMark(notTooLarge(text, where));
    requireReadable(text, where);
    Json root;
    try {
        root = readBytes(text, &root);
    } catch (const typename Json::parse_error& fault) {
        throw badInput({.what = "malformed JSON (" + inShort(reasonIn(fault.what()), longestReasonShown) + ")",
                        .where = where + ", " + placeOfByte(text, fault.byte == 0 ? 0 : fault.byte - 1),
                        .expected = "well-formed JSON",
                        .nextStep = "correct the text at that place"});
    } catch (const typename Json::exception& fault) {
        throw badInput({.what = "malformed JSON (" + inShort(reasonIn(fault.what()), longestReasonShown) + ")",
                        .where = where + ", " + placeOfByte(text, text.find(quotedIn(fault.what()))),
                        .expected = "numbers within the range of 64-bit floating point",
                        .nextStep = "correct the number"});
    }
    requireSingleKeys(text, where);
    return root;
}

bool isReadableStored(std::string_view text) { return text.size() <= largestJson && !firstByteTooDeep(text); }

}  // namespace

nlohmann::json parseStrictJson(std::string_view text, const std::string& where) { return parsed<nlohmann::json>(text, where); }

nlohmann::ordered_json parseStrictOrderedJson(std::string_view text, const std::string& where)
{
    return parsed<nlohmann::ordered_json>(text, where);
}

nlohmann::json storedJson(std::string_view text)
{
    if (!isReadableStored(text)) return nlohmann::json(nlohmann::json::value_t::discarded);
    return nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
}

nlohmann::ordered_json storedOrderedJson(std::string_view text)
{
    if (!isReadableStored(text)) return nlohmann::ordered_json(nlohmann::ordered_json::value_t::discarded);
    return storedJsonInOrder(text);
}

JsonDocument::JsonDocument(std::string_view text, std::string where)
    : m_text(withoutByteOrderMark(notTooLarge(text, where))),
      m_where(std::move(where)),
      m_root(std::make_shared<const nlohmann::json>(parseStrictJson(m_text, m_where)))
{
}

TextPlace JsonDocument::textPlaceOf(std::string_view pointer) const
{
    return textPlaceOfByte(m_text, beginOf(m_text, stepsOf(pointer)));
}

std::string JsonDocument::placeOf(std::string_view pointer) const
{
    return placeOfByte(m_text, beginOf(m_text, stepsOf(pointer)));
}

Error JsonDocument::faultAt(std::string_view pointer, const std::string& what, const std::string& expected,
                            const std::string& nextStep) const
{
    return badInput({what, m_where + ", " + placeOf(pointer), expected, nextStep});
}

std::string pointerStep(std::string_view key)
{
    std::string step;
    for (const char c : key)
        if (c == '~')
            step += "~0";
        else if (c == '/')
            step += "~1";
        else
            step += c;
    return step;
}

std::string pointerOf(std::string_view path)
{
    std::string pointer;
    while (!path.empty()) {
        const std::size_t end = std::min(path.find_first_of(".[]"), path.size());
        if (end > 0) pointer += "/" + pointerStep(path.substr(0, end));
        path.remove_prefix(std::min(end + 1, path.size()));
    }
    return pointer;
}

}  // namespace protocols
