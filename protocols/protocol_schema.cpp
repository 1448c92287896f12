#include "protocols/protocol_schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

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
    return value.is_object() ? "an object" : value.dump();
}

/// The key between the last quotes of valijson's sentence.
std::string quotedKey(const std::string& sentence)
{
    const std::size_t end = sentence.rfind('\'');
    const std::size_t begin = end == std::string::npos || end == 0 ? end : sentence.rfind('\'', end - 1);
    return begin == std::string::npos ? "" : sentence.substr(begin + 1, end - begin - 1);
}

SchemaFault inOurWords(const valijson::ValidationResults::Error& error, const json& schema, const json& document)
{
    std::vector<std::string> steps = stepsOf(error);
    const std::string path = pathOf(steps);
    const std::string whole = path.empty() ? "the protocol: " : path + ": ";
    const bool isMissing = error.description.starts_with("Missing required property");
    if (isMissing || error.description.starts_with("Object contains a property")) {
        const std::string key = quotedKey(error.description);
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

}  // namespace

std::vector<SchemaFault> schemaFaultsOf(const json& document, ProtocolEdition edition)
{
    json schemaJson = json::parse(shipped::protocolSchema());
    if (edition == ProtocolEdition::Before06) liftLimitsOfIds(schemaJson);
    valijson::Schema schema;
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schemaJson), schema);
    valijson::ValidationResults results;
    valijson::Validator(valijson::Validator::kStrongTypes)
        .validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &results);
    std::vector<SchemaFault> faults;
    for (const valijson::ValidationResults::Error& error : results) {
        // valijson reports every container of a fault as failed too; only the fault itself helps the reader.
        if (error.description.starts_with("Failed to validate")) continue;
        const SchemaFault fault = inOurWords(error, schemaJson, document);
        if (std::ranges::find(faults, fault.text, &SchemaFault::text) == faults.end()) faults.push_back(fault);
    }
    return faults;
}

}  // namespace protocols
