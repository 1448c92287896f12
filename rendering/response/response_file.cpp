#include "rendering/response/response_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/number_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"

namespace rendering {

namespace {

using nlohmann::ordered_json;

constexpr const char* hashField = "sha256";

protocols::Error noResponse(const std::string& where, const std::string& what, const std::string& expected)
{
    return protocols::badInput({what, where, expected, "make the file with vis2hap display calibrate"});
}

template <class T>
ordered_json orNull(const std::optional<T>& value)
{
    return value ? ordered_json(*value) : ordered_json();
}

ordered_json jsonOf(const MeasuredLevel& level)
{
    ordered_json json{{"level", level.level}, {"n", level.count}, {"mean", level.mean}, {"fitted", level.fitted}};
    json["half_width_95"] = orNull(level.halfWidth);
    json["up"] = orNull(level.up);
    json["down"] = orNull(level.down);
    return json;
}

ordered_json jsonOf(const DisplayResponse& response)
{
    const ResponseSetting& setting = response.setting;
    ordered_json json{{"schema", responseSchema},  {"display", setting.display},
                      {"date", setting.date},      {"load_n", setting.loadN},
                      {"finger", setting.finger},  {"speed_mm_per_s", setting.speedMmPerS},
                      {"source", response.source}, {"source_sha256", response.sourceSha256}};
    json["noise_sd"] = orNull(response.noise);
    json["hysteresis"] = orNull(response.hysteresis);
    if (!response.noise) json["why"]["noise_sd"] = "no level was measured twice";
    if (!response.hysteresis) json["why"]["hysteresis"] = "no level was measured both rising and falling";
    json["dead_up_to"] = response.deadUpTo;
    json["saturated_from"] = response.saturatedFrom;
    for (const auto& level : response.measured) json["measured"].push_back(jsonOf(level));
    json["lowest_level"] = response.lowestLevel();
    json["friction"] = response.friction;
    return json;
}

/// The members of the object, with faults that name file and member.
class ResponseFields {
public:
    ResponseFields(const ordered_json& object, const std::string& where) : m_object(object), m_where(where) {}

    const ordered_json& member(const char* name) const
    {
        if (!m_object.is_object() || !m_object.contains(name))
            throw noResponse(m_where, std::string("the response has no \"") + name + "\"", "this field");
        return m_object.at(name);
    }
    double number(const char* name, double least, double most) const
    {
        const ordered_json& value = member(name);
        if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < least ||
            value.get<double>() > most)
            throw fault(name, "a number from " + protocols::shortest(least) + " to " + protocols::shortest(most));
        return value.get<double>();
    }
    std::optional<double> numberOrNull(const char* name, double most) const
    {
        return member(name).is_null() ? std::nullopt : std::optional(number(name, 0, most));
    }
    int whole(const char* name, int least, int most) const
    {
        const double value = number(name, least, most);
        if (value != std::floor(value)) throw fault(name, "a whole number");
        return static_cast<int>(value);
    }
    std::string line(const char* name) const
    {
        const ordered_json& value = member(name);
        if (!value.is_string() || !protocols::faultOfLine(value.get<std::string>(), protocols::longestName).empty())
            throw fault(name, protocols::lineRule(protocols::longestName));
        return value.get<std::string>();
    }
    const ordered_json& list(const char* name, std::size_t fewest, std::size_t most) const
    {
        const ordered_json& value = member(name);
        if (!value.is_array() || value.size() < fewest || value.size() > most)
            throw fault(name, "a list of " + std::to_string(fewest) + " to " + std::to_string(most) + " entries");
        return value;
    }
    protocols::Error fault(const char* name, const std::string& expected) const
    {
        return noResponse(m_where, std::string("the field \"") + name + "\" of the response is wrong", expected);
    }

private:
    const ordered_json& m_object;
    const std::string& m_where;
};

constexpr double mostFriction = 1000;

MeasuredLevel measuredLevelFrom(const ordered_json& json, const std::string& where)
{
    const ResponseFields fields(json, where);
    return {.level = fields.whole("level", 0, 255),
            .count = fields.whole("n", 1, 1000000000),
            .mean = fields.number("mean", 0, mostFriction),
            .fitted = fields.number("fitted", 0, mostFriction),
            .halfWidth = fields.numberOrNull("half_width_95", 1e6),
            .up = fields.numberOrNull("up", mostFriction),
            .down = fields.numberOrNull("down", mostFriction)};
}

void requireCurve(const DisplayResponse& response, const ResponseFields& fields)
{
    const auto rises = [](const MeasuredLevel& a, const MeasuredLevel& b) { return a.level >= b.level; };
    if (std::adjacent_find(response.measured.begin(), response.measured.end(), rises) != response.measured.end())
        throw fields.fault("measured", "rising levels");
    const auto levels = static_cast<std::size_t>(response.highestLevel() - response.lowestLevel() + 1);
    if (response.friction.size() != levels || !std::is_sorted(response.friction.begin(), response.friction.end()) ||
        response.isFlat())
        throw fields.fault("friction", std::to_string(levels) +
                                           " values that never fall, the last above the first by more "
                                           "than a millionth of their mean");
}

}  // namespace

std::string responseJson(const DisplayResponse& response)
{
    ordered_json json = jsonOf(response);
    json[hashField] = protocols::sha256(json.dump());
    return json.dump(1) + "\n";
}

DisplayResponse responseFromJson(std::string_view text, const std::string& where)
{
    ordered_json json = protocols::parseStrictOrderedJson(text, where);
    const ResponseFields fields(json, where);
    if (!fields.member("schema").is_string() || fields.member("schema") != responseSchema)
        throw noResponse(where, "this is no response of a display", std::string("the schema ") + responseSchema);
    const std::string stated = fields.line(hashField);
    ordered_json hashed = json;
    hashed.erase(hashField);
    if (protocols::sha256(hashed.dump()) != stated)
        throw noResponse(where, "the response was altered after it was made", "the text that its field sha256 states");
    DisplayResponse response;
    response.setting = {.display = fields.line("display"),
                        .finger = fields.line("finger"),
                        .date = fields.line("date"),
                        .loadN = fields.number("load_n", 1e-6, 1000),
                        .speedMmPerS = fields.number("speed_mm_per_s", 1e-6, 1e5)};
    response.source = fields.line("source");
    response.sourceSha256 = fields.line("source_sha256");
    response.noise = fields.numberOrNull("noise_sd", mostFriction);
    response.hysteresis = fields.numberOrNull("hysteresis", mostFriction);
    for (const auto& level : fields.list("measured", fewestLevels, 256))
        response.measured.push_back(measuredLevelFrom(level, where));
    for (const auto& value : fields.list("friction", 2, 256)) {
        if (!value.is_number() || !(value.get<double>() >= 0 && value.get<double>() <= mostFriction))
            throw fields.fault("friction", "friction coefficients");
        response.friction.push_back(value.get<double>());
    }
    response.deadUpTo = fields.whole("dead_up_to", 0, 255);
    response.saturatedFrom = fields.whole("saturated_from", 0, 255);
    response.sha256 = stated;
    requireCurve(response, fields);
    return response;
}

DisplayResponse readResponse(const std::filesystem::path& file)
{
    return responseFromJson(protocols::readRegularFile(file, largestResponseFile), file.string());
}

std::string measuredText(const ResponseSetting& setting)
{
    return "measured on " + setting.date + " on " + setting.display + " at " + protocols::shortest(setting.loadN) + " N and " +
           protocols::shortest(setting.speedMmPerS) + " mm/s with " + setting.finger;
}

}  // namespace rendering
