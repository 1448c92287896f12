#include "protocols/records/key_json.h"

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"

namespace protocols {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* allocationSchema = "vis2hap.allocation-key/2";
constexpr const char* olderSchema = "vis2hap.allocation-key/1";

Error malformed(const std::string& what, const std::string& where, const std::string& expected)
{
    return badInput({.what = what, .where = where, .expected = expected, .nextStep = "restore the file from a backup"});
}

json documentOf(std::string_view text, const std::string& schema, const std::string& where)
{
    json document = parseStrictJson(text, where);
    if (!document.is_object() || !document.contains("schema") || document.at("schema") != schema)
        throw malformed("not a key of this kind", where, "\"schema\": \"" + schema + "\"");
    if (!document.contains("entries") || !document.at("entries").is_object())
        throw malformed("entries are missing", where, "an object from file codes to their meaning");
    return document;
}

std::string textIn(const json& entry, const char* name, const std::string& where)
{
    if (!entry.is_object() || !entry.contains(name) || !entry.at(name).is_string() || entry.at(name).get<std::string>().empty())
        throw malformed(std::string("'") + name + "' is missing", where, "a text that is not empty");
    return entry.at(name).get<std::string>();
}

ConditionId conditionIn(const json& entry, const std::string& where)
{
    const std::string id = textIn(entry, "condition", where);
    if (id == catchTrialId().value) return catchTrialId();
    if (!faultOf(id) && conditionIdFrom(id).value == id) return ConditionId(id);
    if (faultOfOwnId(id).empty()) return ConditionId(id);
    throw malformed("unknown condition '" + id + "'", where, "the id of a condition");
}

std::map<FileCode, AllocationKey::Entry> entriesOf(const json& document, const std::string& where)
{
    std::map<FileCode, AllocationKey::Entry> entries;
    std::set<std::pair<FabricId, ConditionId>> seen;
    std::map<ConditionLabel, ConditionId> meanings;
    for (const auto& [code, entry] : document.at("entries").items()) {
        const std::string place = where + ", " + code;
        const FabricId fabric(textIn(entry, "fabric", place));
        const ConditionId condition = conditionIn(entry, place);
        const ConditionLabel label(textIn(entry, "label", place));
        if (!seen.insert({fabric, condition}).second)
            throw malformed("a second file code for " + fabric.value + " and " + condition.value, place,
                            "one for each rendering");
        if (meanings.emplace(label, condition).first->second != condition)
            throw malformed(label.value + " stands for two conditions", place, "one condition for each label");
        entries[FileCode(code)] = {fabric, condition, label};
    }
    return entries;
}

std::string inLines(const ordered_json& document) { return document.dump(2) + "\n"; }

}  // namespace

std::string toJson(const AllocationKey& key)
{
    ordered_json document{{"schema", allocationSchema}, {"secret", key.secret.hex()}, {"entries", ordered_json::object()}};
    for (const auto& [code, entry] : key.entries)
        document["entries"][code.value] = {
            {"fabric", entry.fabric.value}, {"condition", entry.condition.value}, {"label", entry.label.value}};
    return inLines(document);
}

AllocationKey allocationKeyFromJson(std::string_view text, const std::string& where)
{
    const json document = documentOf(text, allocationSchema, where);
    return {entriesOf(document, where), SecretKey::ofHex(textIn(document, "secret", where), where)};
}

std::map<FileCode, AllocationKey::Entry> olderKeyEntriesFromJson(std::string_view text, const std::string& where)
{
    return entriesOf(documentOf(text, olderSchema, where), where);
}

}  // namespace protocols
