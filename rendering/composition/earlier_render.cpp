#include "rendering/composition/earlier_render.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"

namespace rendering {

namespace {

using nlohmann::ordered_json;
using Names = std::set<std::string>;

JoinedRender replaced(const std::string& json, const std::string& where)
{
    return {json,
            {where + ": cannot be read and is replaced; the ranges of the images in that folder are unknown: render them again"}};
}

/// Strings of an array; throws nlohmann's exceptions for anything else.
Names namesIn(const ordered_json& condition, const char* field)
{
    Names names;
    if (condition.contains(field))
        for (const auto& name : condition.at(field)) names.insert(name.get<std::string>());
    return names;
}

std::string listed(const Names& names)
{
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

Names without(const Names& names, const Names& others)
{
    Names rest;
    std::set_difference(names.begin(), names.end(), others.begin(), others.end(), std::inserter(rest, rest.end()));
    return rest;
}

std::string rangeText(const ordered_json& condition)
{
    const ordered_json& range = condition.at("range");
    return range.at("min").dump() + " to " + range.at("max").dump();
}

/// Differences between two renderings of a condition, in words; empty where their images can be compared.
std::string difference(const ordered_json& now, const ordered_json& before)
{
    const Names over = namesIn(now, "range_over"), wasOver = namesIn(before, "range_over");
    const Names added = without(over, wasOver), gone = without(wasOver, over);
    std::string text;
    const auto add = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
    if (!added.empty()) add("its range now includes " + listed(added));
    if (!gone.empty()) add("its range no longer includes " + listed(gone));
    if (now.at("range") != before.at("range") || now.value("ranges", ordered_json()) != before.value("ranges", ordered_json()))
        add("the range was " + rangeText(before) + " and is now " + rangeText(now));
    // Files of earlier versions state no quality for each condition.
    if (before.contains("quality") && before.at("quality") != now.value("quality", ordered_json()))
        add("the quality was " + before.at("quality").dump() + " and is now " + now.value("quality", ordered_json()).dump());
    if (now.at("mapping") != before.value("mapping", ordered_json()))
        add("the mapping was " + before.value("mapping", ordered_json()).dump() + " and is now " + now.at("mapping").dump());
    return text;
}

/// Copies the facts on fabrics whose images are not rendered again.
void keepFacts(ordered_json& now, const ordered_json& before, const Names& fabrics)
{
    for (const char* field : {"extension", "agreement", "variance_lost", "outside_range", "out_of_reach"})
        for (const auto& fabric : fabrics)
            if (before.contains(field) && before.at(field).contains(fabric)) now[field][fabric] = before.at(field).at(fabric);
}

void joinCondition(const std::string& id, ordered_json& now, const ordered_json& before, const std::string& otherData,
                   const std::string& where, std::vector<std::string>& warnings)
{
    const Names images = namesIn(now, "images");
    const Names kept = without(namesIn(before, "images"), images);
    Names otherwise = without(namesIn(before, "mapped_otherwise"), images);
    std::string changed = difference(now, before);
    if (!otherData.empty()) changed += (changed.empty() ? "" : "; ") + otherData;
    if (changed.empty()) {
        for (const auto& fabric : kept) now["images"].push_back(fabric);
        keepFacts(now, before, kept);
    } else {
        otherwise.insert(kept.begin(), kept.end());
        warnings.push_back(
            where + ": " + id + ": " + changed +
            (kept.empty() ? "" : "; the images of " + listed(kept) + " in that folder keep the old one: render them again"));
    }
    if (!otherwise.empty()) now["mapped_otherwise"] = otherwise;
}

JoinedRender joinedOrThrow(const std::string& json, std::string_view earlier, const std::string& where)
{
    ordered_json now = ordered_json::parse(json);
    const ordered_json before = protocols::parseStrictOrderedJson(earlier, where);
    JoinedRender result;
    const std::string data = before.at("dataset").get<std::string>();
    const std::string otherData =
        data == now.at("dataset") ? "" : "the data set was " + data + " and is now " + now.at("dataset").get<std::string>();
    for (const auto& [id, condition] : before.at("conditions").items()) {
        if (now.at("conditions").contains(id))
            joinCondition(id, now["conditions"][id], condition, otherData, where, result.warnings);
        else
            now["conditions"][id] = condition;
    }
    for (const auto& [fabric, samples] : before.at("samples").items())
        if (!now.at("samples").contains(fabric)) now["samples"][fabric] = samples;
    if (before.contains("photographs"))
        for (const auto& [fabric, facts] : before.at("photographs").items())
            if (!now.contains("photographs") || !now.at("photographs").contains(fabric)) now["photographs"][fabric] = facts;
    result.json = now.dump(2) + "\n";
    return result;
}

}  // namespace

JoinedRender joined(const std::string& json, std::string_view earlier, const std::string& where)
{
    try {
        return joinedOrThrow(json, earlier, where);
    } catch (const nlohmann::json::exception&) {
        return replaced(json, where);
    } catch (const protocols::Error&) {
        return replaced(json, where);
    }
}

}  // namespace rendering
