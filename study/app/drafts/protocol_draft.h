// A protocol that is being written, as a value: the document of its file. A page changes single places of it, so fields that no
// page shows stay as they are. A draft may have faults; protocols::checkedProtocol() names them by the same places.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace study::app {

/// How the text of a field becomes a value of the document.
enum class FieldKind {
    Text,    ///< a text
    Number,  ///< a number, with comma or point; other words stay a text, which the check then refuses
    Lines,   ///< a list of texts, one a line
};

class ProtocolDraft {
public:
    /// Without name, fabrics, conditions and phases.
    ProtocolDraft();
    /// `where` names the source in errors. Throws badInput where the text is not JSON, or holds no object.
    static ProtocolDraft fromText(std::string_view text, const std::string& where);

    /// The file, in UTF-8 with a line break at its end.
    std::string fileText() const;

    /// The value at a place such as "phases[0].scale.min"; null where there is none. A bracket that holds no number of at most
    /// nine digits is a part of a key.
    const nlohmann::ordered_json& at(std::string_view place) const;
    bool has(std::string_view place) const { return !at(place).is_null(); }
    /// Sets the value. Objects that are missing on the way are made; a value on the way that holds nothing is replaced.
    void set(std::string_view place, nlohmann::ordered_json value);
    /// Removes the value, if there is one.
    void erase(std::string_view place);
    /// Removes a key of the object at the place, "" for the document. The key is taken as it stands, also with brackets and
    /// points. False where there is no such object or key; then nothing changes.
    bool eraseKey(std::string_view object, const std::string& key);

    /// The value as a field shows it; a list is shown one element a line.
    std::string typedAt(std::string_view place) const;
    /// Sets the value from the text of a field; an empty text removes it.
    void setTyped(std::string_view place, FieldKind kind, std::string_view typed);

    /// Number of elements of the list at the place; 0 where there is no list.
    std::size_t countAt(std::string_view place) const;

    const nlohmann::ordered_json& document() const { return m_document; }
    bool operator==(const ProtocolDraft&) const = default;

private:
    nlohmann::ordered_json m_document;  ///< an object
};

/// The number in a typed text, with comma or point; else the text itself.
nlohmann::ordered_json valueOfTyped(std::string_view typed);

/// Whether this is the protocol file of a study that exists. Such a file is changed by `vis2hap study amend`.
bool belongsToStudy(const std::filesystem::path& file);

/// Makes relative folders of ready images absolute, because the draft is saved in another folder than `from`.
void makeImageFoldersAbsolute(ProtocolDraft& draft, const std::filesystem::path& from);

/// Files beside the protocol that it names: recordings for the headphones.
std::vector<std::string> filesBeside(const ProtocolDraft& draft);

}  // namespace study::app
