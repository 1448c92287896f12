#include "database/stored_texts.h"

#include <QDateTime>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"

namespace database {

namespace {

template <class Enum>
Enum namedValue(const std::string& name, std::initializer_list<Enum> values)
{
    for (const Enum value : values)
        if (nameOf(value) == name) return value;
    throw protocols::workFailed(
        {"the database holds an unknown name, \"" + name + "\"", "study.db", "", "run vis2hap verify on the study"});
}

}  // namespace

std::string jsonOf(const std::vector<std::string>& texts)
{
    return nlohmann::json(texts).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<std::string> textsOf(const std::string& json)
{
    const nlohmann::json parsed = protocols::storedJson(json);
    std::vector<std::string> texts;
    if (!parsed.is_array())
        throw protocols::workFailed(
            {"a stored list cannot be read: " + json, "study.db", "a JSON array of texts", "run vis2hap verify on the study"});
    for (const nlohmann::json& text : parsed) texts.push_back(text.is_string() ? text.get<std::string>() : text.dump());
    return texts;
}

std::string jsonOf(const std::vector<protocols::FabricId>& fabrics)
{
    std::vector<std::string> texts;
    for (const protocols::FabricId& fabric : fabrics) texts.push_back(fabric.value);
    return jsonOf(texts);
}

std::vector<protocols::FabricId> fabricsOf(const std::string& json)
{
    std::vector<protocols::FabricId> fabrics;
    for (const std::string& text : textsOf(json)) fabrics.emplace_back(text);
    return fabrics;
}

ParticipantKind kindNamed(const std::string& name)
{
    return namedValue(name, {ParticipantKind::Human, ParticipantKind::Scripted, ParticipantKind::Simulated});
}

SlotState stateNamed(const std::string& name)
{
    return namedValue(name, {SlotState::Free, SlotState::Started, SlotState::Finished, SlotState::Withdrawn});
}

std::string wallTimeNow() { return QDateTime::currentDateTimeUtc().toString(Qt::ISODateWithMs).toStdString(); }

}  // namespace database
