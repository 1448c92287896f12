#include "study/app/drafts/protocol_draft.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"

namespace study::app {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

const Json& noValue()
{
    static const Json null;
    return null;
}

/// The steps of "phases[0].scale.min": keys, and whole numbers as "[0]".
std::vector<std::string> stepsTo(std::string_view place)
{
    std::vector<std::string> steps;
    std::string step;
    const auto end = [&] {
        if (!step.empty()) steps.push_back(std::exchange(step, {}));
    };
    for (const char c : place) {
        if (c == '.' || c == '[') end();
        if (c != '.') step += c;
    }
    end();
    return steps;
}

/// The number in "[12]"; none in a step that is a key, even one that holds brackets.
std::optional<std::size_t> elementOf(std::string_view step)
{
    constexpr std::size_t mostDigits = 9;
    if (!step.starts_with('[') || !step.ends_with(']') || step.size() < 3 || step.size() > mostDigits + 2) return std::nullopt;
    const std::string_view digits = step.substr(1, step.size() - 2);
    std::size_t number = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return fault == std::errc() && end == digits.data() + digits.size() ? std::optional(number) : std::nullopt;
}

const Json& memberOf(const Json& value, const std::string& step)
{
    if (const auto element = elementOf(step)) return value.is_array() && *element < value.size() ? value[*element] : noValue();
    const auto found = value.is_object() ? value.find(step) : value.end();
    return found == value.end() ? noValue() : *found;
}

Json& madeMember(Json& value, const std::string& step)
{
    if (const auto element = elementOf(step)) {
        if (!value.is_array()) value = Json::array();
        while (value.size() <= *element) value.push_back(Json());
        return value[*element];
    }
    if (!value.is_object()) value = Json::object();
    return value[step];
}

std::string typedOf(const Json& value)
{
    if (value.is_null()) return {};
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) return protocols::shortest(value.get<double>());
    if (!value.is_array()) return value.dump();
    std::string lines;
    for (const Json& element : value) lines += (lines.empty() ? "" : "\n") + typedOf(element);
    return lines;
}

std::string trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first == std::string_view::npos ? std::string()
                                           : std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

Json linesOf(std::string_view typed)
{
    Json lines = Json::array();
    for (std::size_t from = 0; from <= typed.size();) {
        const std::size_t to = std::min(typed.find('\n', from), typed.size());
        if (const std::string line = trimmed(typed.substr(from, to - from)); !line.empty()) lines.push_back(line);
        from = to + 1;
    }
    return lines;
}

}  // namespace

ProtocolDraft::ProtocolDraft()
    : m_document({{"schema", "vis2hap.protocol/1"},
                  {"name", ""},
                  {"participants", 10},
                  {"fabrics", 5},
                  {"conditions", Json::array()},
                  {"phases", Json::array()}})
{
}

ProtocolDraft ProtocolDraft::fromText(std::string_view text, const std::string& where)
{
    ProtocolDraft draft;
    draft.m_document = protocols::parseStrictOrderedJson(text, where);
    if (!draft.m_document.is_object())
        throw protocols::badInput({"the file holds no protocol", where, "an object with the fields of a protocol",
                                   "choose a protocol file, or begin with an example"});
    return draft;
}

std::string ProtocolDraft::fileText() const { return m_document.dump(2) + "\n"; }

const Json& ProtocolDraft::at(std::string_view place) const
{
    const Json* value = &m_document;
    for (const std::string& step : stepsTo(place)) value = &memberOf(*value, step);
    return *value;
}

void ProtocolDraft::set(std::string_view place, Json value)
{
    Json* here = &m_document;
    for (const std::string& step : stepsTo(place)) here = &madeMember(*here, step);
    *here = std::move(value);
}

void ProtocolDraft::erase(std::string_view place)
{
    std::vector<std::string> steps = stepsTo(place);
    if (steps.empty() || at(place).is_null()) return;
    const std::string last = steps.back();
    steps.pop_back();
    Json* here = &m_document;
    for (const std::string& step : steps) here = &madeMember(*here, step);
    if (const auto element = elementOf(last))
        here->erase(*element);
    else
        here->erase(last);
}

bool ProtocolDraft::eraseKey(std::string_view object, const std::string& key)
{
    if (!at(object).is_object() || !at(object).contains(key)) return false;
    Json* here = &m_document;
    for (const std::string& step : stepsTo(object)) here = &madeMember(*here, step);
    here->erase(key);
    return true;
}

std::string ProtocolDraft::typedAt(std::string_view place) const { return typedOf(at(place)); }

void ProtocolDraft::setTyped(std::string_view place, FieldKind kind, std::string_view typed)
{
    Json value;
    switch (kind) {
        case FieldKind::Text:
            value = trimmed(typed).empty() ? std::string() : std::string(typed);
            break;
        case FieldKind::Number:
            value = valueOfTyped(typed);
            break;
        case FieldKind::Lines:
            value = linesOf(typed);
            break;
    }
    if (value.empty() || value == "")
        erase(place);
    else
        set(place, std::move(value));
}

std::size_t ProtocolDraft::countAt(std::string_view place) const
{
    const Json& value = at(place);
    return value.is_array() ? value.size() : 0;
}

Json valueOfTyped(std::string_view typed)
{
    const std::string plain = trimmed(typed);
    std::string number = plain;
    std::ranges::replace(number, ',', '.');
    if (number.starts_with('+')) number.erase(0, 1);
    constexpr double largestWhole = 1e15;
    double value = 0;
    const auto [end, fault] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (number.empty() || fault != std::errc() || end != number.data() + number.size() || !std::isfinite(value)) return plain;
    if (value == std::floor(value) && std::abs(value) < largestWhole) return static_cast<long long>(value);
    return value;
}

bool belongsToStudy(const fs::path& file)
{
    std::error_code unknown;
    return fs::exists(fs::absolute(file, unknown).parent_path() / "study.db", unknown);
}

void makeImageFoldersAbsolute(ProtocolDraft& draft, const fs::path& from)
{
    for (std::size_t i = 0; i < draft.countAt("conditions"); ++i) {
        const std::string place = "conditions[" + std::to_string(i) + "].images";
        const Json& folder = draft.at(place);
        if (!folder.is_string() || folder.get<std::string>().empty() || fs::path(folder.get<std::string>()).is_absolute())
            continue;
        draft.set(place, (from / folder.get<std::string>()).lexically_normal().string());
    }
}

std::vector<std::string> filesBeside(const ProtocolDraft& draft)
{
    std::set<std::string> files;
    for (const auto& [key, file] : draft.at("prompts").items())
        if (file.is_string()) files.insert(file.get<std::string>());
    return {files.begin(), files.end()};
}

}  // namespace study::app
