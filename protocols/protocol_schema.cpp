#include "protocols/protocol_schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "protocols/files/utf8.h"
#include "protocols/texts/shipped_texts.h"

namespace protocols {

namespace {

using nlohmann::json;

/// The steps to the fault: valijson's "<root>", "[phases]", "[0]" without brackets and root.
std::vector<std::string> stepsOf(const valijson::ValidationResults::Error& error)
{
    std::vector<std::string> steps;
    for (const std::string& step : error.context)
        if (step.size() >= 2 && step.front() == '[') steps.push_back(step.substr(1, step.size() - 2));
    return steps;
}

bool isIndex(const std::string& step)
{
    return !step.empty() && std::ranges::all_of(step, [](char c) { return c >= '0' && c <= '9'; });
}

/// "phases[0].alternatives"; empty for the whole document.
std::string pathOf(const std::vector<std::string>& steps)
{
    std::string path;
    for (const std::string& step : steps) {
        if (isIndex(step))
            path += "[" + step + "]";
        else
            path += (path.empty() ? "" : ".") + step;
    }
    return path;
}

/// The schema's description of the value at `steps`; empty where it has none.
std::string expectationAt(const json& schema, const std::vector<std::string>& steps)
{
    const json* node = &schema;
    for (const std::string& step : steps) {
        if (isIndex(step) && node->contains("items"))
            node = &(*node)["items"];
        else if (node->contains("properties") && (*node)["properties"].contains(step))
            node = &(*node)["properties"][step];
        else if (node->contains("additionalProperties") && (*node)["additionalProperties"].is_object())
            node = &(*node)["additionalProperties"];
        else
            return "";
    }
    return node->value("description", "");
}

const json* valueAt(const json& document, const std::vector<std::string>& steps)
{
    const json* node = &document;
    for (const std::string& step : steps) {
        if (node->is_array() && isIndex(step) && std::stoull(step) < node->size())
            node = &(*node)[std::stoull(step)];
        else if (node->is_object() && node->contains(step))
            node = &(*node)[step];
        else
            return nullptr;
    }
    return node;
}

std::string inBrief(const json& value)
{
    if (value.is_array()) return "a list of " + std::to_string(value.size());
    constexpr std::size_t longestShown = 100;  // bytes
    return value.is_object() ? "an object" : inShort(value.dump(), longestShown);
}

/// The key at the end of valijson's sentence, behind `before`. The key may hold quotes itself.
std::string quotedKey(const std::string& sentence, std::string_view before)
{
    const std::size_t begin = sentence.find(before), end = sentence.rfind('\'');
    const std::size_t from = begin + before.size();
    return begin == std::string::npos || end == std::string::npos || end < from ? "" : sentence.substr(from, end - from);
}

SchemaFault inOurWords(const valijson::ValidationResults::Error& error, const json& schema, const json& document)
{
    std::vector<std::string> steps = stepsOf(error);
    const std::string path = pathOf(steps);
    const std::string whole = path.empty() ? "the protocol: " : path + ": ";
    const bool isMissing = error.description.starts_with("Missing required property");
    if (isMissing || error.description.starts_with("Object contains a property")) {
        const std::string key = quotedKey(error.description, isMissing ? "property '" : "constraints: '");
        steps.push_back(key);
        return {pathOf(steps), whole + (isMissing ? "'" + key + "' is missing" : "unknown key '" + key + "'")};
    }
    const json* value = valueAt(document, steps);
    const std::string expectation = expectationAt(schema, steps);
    if (value == nullptr || expectation.empty()) return {path, whole + error.description};
    return {path, whole + inBrief(*value) + ", expected " + expectation};
}

/// Takes the limits of question ids out of the schema.
void liftLimitsOfIds(json& schema)
{
    json& phase = schema["properties"]["phases"]["items"]["properties"];
    for (const char* list : {"questions", "free_text"})
        for (const char* limit : {"pattern", "maxLength"}) phase[list]["items"].erase(limit);
}

/// The faults so far, each text once.
class SchemaFaultList {
public:
    void add(SchemaFault fault)
    {
        constexpr std::size_t longestText = 1000;  // bytes; keys stand in it
        fault.text = inShort(fault.text, longestText);
        if (!m_texts.insert(fault.text).second) return;
        if (m_faults.listed.size() < mostFaults)
            m_faults.listed.push_back(std::move(fault));
        else
            ++m_faults.unlisted;
    }

    bool isEmpty() const { return m_faults.listed.empty(); }
    SchemaFaults take() { return std::move(m_faults); }

private:
    SchemaFaults m_faults;
    std::set<std::string> m_texts;
};

/// Adds a fault for each list and object at or below `value` that is too long. Returns the number of values.
std::size_t checkLengths(const json& value, const std::string& path, SchemaFaultList& faults)
{
    if (!value.is_structured()) return 1;
    if (value.size() > mostElements) {
        faults.add({path, (path.empty() ? "the protocol" : path) + ": " + std::to_string(value.size()) +
                              (value.is_array() ? " elements" : " keys") + ", expected at most " + std::to_string(mostElements)});
        return 1;
    }
    std::size_t values = 1;
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i)
            values += checkLengths(value[i], path + "[" + std::to_string(i) + "]", faults);
    else
        for (const auto& [key, member] : value.items())
            values += checkLengths(member, path.empty() ? key : path + "." + key, faults);
    return values;
}

bool hasEqualElements(const json& list)
{
    const auto isLess = [](const json* a, const json* b) { return *a < *b; };
    std::set<const json*, decltype(isLess)> seen(isLess);
    return !std::ranges::all_of(list, [&](const json& element) { return seen.insert(&element).second; });
}

/// Checks `uniqueItems` and takes it out of the schema: valijson would report each pair of equal elements.
void checkUniqueness(json& schema, const json& document, SchemaFaultList& faults)
{
    for (auto& [key, rule] : schema["properties"].items())
        if (rule.erase("uniqueItems") > 0 && document.contains(key) && document[key].is_array() &&
            hasEqualElements(document[key]))
            faults.add({key, key + ": " + inBrief(document[key]) + ", expected " + expectationAt(schema, {key})});
}

/// The document with the beginnings of long texts. They break the same rules: the program's regular expressions are recursive,
/// and the schema has none for texts of more than 100 characters, and no greatest length beyond 2000.
json withShortTexts(const json& value)
{
    constexpr std::size_t longestText = 10'000;  // bytes, more than 2000 characters have
    if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        return text.size() > longestText ? json(inShort(text, longestText)) : value;
    }
    json copy = value;
    if (value.is_structured())
        for (json& part : copy) part = withShortTexts(part);
    return copy;
}

}  // namespace

SchemaFaults schemaFaultsOf(const json& document, ProtocolEdition edition)
{
    SchemaFaultList faults;
    if (!document.is_object()) {
        faults.add({"", "the protocol: " + inBrief(document) + ", expected an object with the fields of a protocol"});
        return faults.take();
    }
    const std::size_t values = checkLengths(document, "", faults);
    if (values > mostValues)
        faults.add({"", "the protocol: " + std::to_string(values) + " values, expected at most " + std::to_string(mostValues)});
    if (!faults.isEmpty()) {
        SchemaFaults ofSize = faults.take();
        ofSize.isTooLarge = true;
        return ofSize;
    }
    json schemaJson = json::parse(shipped::protocolSchema());
    if (edition == ProtocolEdition::Before06) liftLimitsOfIds(schemaJson);
    checkUniqueness(schemaJson, document, faults);
    valijson::Schema schema;
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schemaJson), schema);
    valijson::ValidationResults results;
    const json checked = withShortTexts(document);
    valijson::Validator(valijson::Validator::kStrongTypes)
        .validate(schema, valijson::adapters::NlohmannJsonAdapter(checked), &results);
    for (const valijson::ValidationResults::Error& error : results)
        // valijson reports every container of a fault as failed too; only the fault itself helps the reader.
        if (!error.description.starts_with("Failed to validate")) faults.add(inOurWords(error, schemaJson, document));
    return faults.take();
}

}  // namespace protocols
