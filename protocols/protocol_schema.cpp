#include "protocols/protocol_schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "protocols/shipped_texts.h"

namespace protocols {

namespace {

using nlohmann::json;

/// valijson's steps are "<root>", "[phases]", "[0]"; without their brackets, root left out.
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

/// "phases[0].alternatives"
std::string pathOf(const std::vector<std::string>& steps)
{
    std::string path;
    for (const std::string& step : steps) {
        if (isIndex(step))
            path += "[" + step + "]";
        else
            path += (path.empty() ? "" : ".") + step;
    }
    return path.empty() ? "the protocol" : path;
}

/// What the schema says in words about the value at `steps`; empty where it says nothing.
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

/// A missing or surplus key, named between the last quotes of valijson's sentence.
std::string quotedName(const std::string& sentence)
{
    const std::size_t end = sentence.rfind('\'');
    const std::size_t begin = end == std::string::npos || end == 0 ? end : sentence.rfind('\'', end - 1);
    return begin == std::string::npos ? "" : sentence.substr(begin, end - begin + 1);
}

std::string inOurWords(const valijson::ValidationResults::Error& error, const json& schema, const json& document)
{
    const std::vector<std::string> steps = stepsOf(error);
    const std::string place = pathOf(steps) + ": ";
    if (error.description.starts_with("Missing required property")) return place + quotedName(error.description) + " is missing";
    if (error.description.starts_with("Object contains a property"))
        return place + "unknown key " + quotedName(error.description);
    const json* value = valueAt(document, steps);
    const std::string expectation = expectationAt(schema, steps);
    if (value == nullptr || expectation.empty()) return place + error.description;
    return place + inBrief(*value) + ", expected " + expectation;
}

}  // namespace

std::vector<std::string> schemaFaultsOf(const json& document)
{
    const json schemaJson = json::parse(shipped::protocolSchema());
    valijson::Schema schema;
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schemaJson), schema);
    valijson::ValidationResults results;
    valijson::Validator(valijson::Validator::kStrongTypes)
        .validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &results);
    std::vector<std::string> faults;
    for (const valijson::ValidationResults::Error& error : results) {
        // Every container of a fault is reported as failed too; only the fault itself helps anybody.
        if (error.description.starts_with("Failed to validate")) continue;
        const std::string fault = inOurWords(error, schemaJson, document);
        if (std::ranges::find(faults, fault) == faults.end()) faults.push_back(fault);
    }
    return faults;
}

}  // namespace protocols
