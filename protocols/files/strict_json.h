// JSON read strictly: malformed text, bytes that are not UTF-8 and keys that occur twice in an object are refused with
// line and column. Texts that are too large or nested too deeply are refused before they take memory. A document knows the place
// of each of its values, so that later faults can name it, too.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "protocols/files/errors.h"

namespace protocols {

/// Largest text, bytes. Its values take up to 16 times as much memory.
inline constexpr std::size_t largestJson = std::size_t{1} << 27;

/// Most objects and arrays inside each other. Copies and comparisons of values are recursive.
inline constexpr std::size_t deepestJson = 100;

/// `where` names the source in errors. Throws badInput.
nlohmann::json parseStrictJson(std::string_view text, const std::string& where);

/// The same with the keys of objects in the order of the text.
nlohmann::ordered_json parseStrictOrderedJson(std::string_view text, const std::string& where);

/// What this program stored itself: rows of a database, files of a study, kept results. Somebody may have altered it. A text that
/// is malformed, too large or nested too deeply gives a discarded value, which is no object, array, text or number. Nothing is
/// thrown. Of a key that occurs twice the last value counts.
nlohmann::json storedJson(std::string_view text);
nlohmann::ordered_json storedOrderedJson(std::string_view text);

/// A place in a text; both numbers count from 1, columns in characters.
struct TextPlace {
    std::size_t line = 1;
    std::size_t column = 1;
};

/// A parsed text together with the places of its values.
class JsonDocument {
public:
    /// `where` names the source in errors. Throws badInput as parseStrictJson() does.
    JsonDocument(std::string_view text, std::string where);

    const nlohmann::json& root() const { return *m_root; }
    const std::string& where() const { return m_where; }

    /// "line 3, column 5" of the first character of a value; columns count characters, not bytes. `pointer` is a JSON
    /// pointer (RFC 6901): "" is the root, "/phases/0/scale" a member. A value that is missing has the place of the
    /// innermost object or array that should hold it.
    std::string placeOf(std::string_view pointer) const;
    TextPlace textPlaceOf(std::string_view pointer) const;

    /// The fault of a value, ready to throw: badInput at "FILE, line 3, column 5".
    Error faultAt(std::string_view pointer, const std::string& what, const std::string& expected,
                  const std::string& nextStep = "") const;

private:
    std::string m_text, m_where;
    std::shared_ptr<const nlohmann::json> m_root;
};

/// A key as one step of a JSON pointer: "a/b" is "a~1b".
std::string pointerStep(std::string_view key);

/// The JSON pointer of a path as messages write it: "phases[0].scale" is "/phases/0/scale".
std::string pointerOf(std::string_view path);

}  // namespace protocols
