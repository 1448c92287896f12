#include "study/participant/instruction.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocols/files/strict_json.h"

namespace study::participant {

namespace {

using Json = nlohmann::ordered_json;
using protocols::Tenths;

constexpr std::pair<Task, const char*> taskNames[] = {
    {Task::Read, "read"}, {Task::Consent, "consent"}, {Task::Facts, "facts"}, {Task::Scale, "scale"}};

Json jsonOf(const ScaleTask& task)
{
    Json json{{"min", task.scale.min.value},
              {"max", task.scale.max.value},
              {"step", task.scale.step.value},
              {"sections", task.scale.sections},
              {"labels", task.scale.labels},
              {"low", task.low},
              {"high", task.high},
              {"tap", task.tap},
              {"say", task.say},
              {"count", task.count}};
    if (task.asked) json["asked"] = task.asked->value;
    if (task.last)
        json["last"] = {{"shown", task.last->shown.value},
                        {"named", task.last->named.value},
                        {"is_right", task.last->isRight},
                        {"text", task.last->text}};
    return json;
}

/// A fraction or a number beyond every scale would silently become another one.
int wholeIn(const nlohmann::json& json, const char* key)
{
    constexpr std::int64_t largest = 1'000'000;
    const auto& value = json.at(key);
    // A number beyond 2^63 would become a negative one.
    const bool isWhole = value.is_number_integer() && !(value.is_number_unsigned() && value.get<std::uint64_t>() > largest);
    const auto whole = isWhole ? value.get<std::int64_t>() : largest + 1;
    if (whole < -largest || whole > largest)
        throw protocols::badInput({std::string(key) + " is no whole number from -1000000 to 1000000", "an instruction", "", ""});
    return static_cast<int>(whole);
}

Tenths tenthsIn(const nlohmann::json& json, const char* key) { return {wholeIn(json, key)}; }

ScaleTask scaleTaskIn(const nlohmann::json& json)
{
    ScaleTask task;
    task.scale = {tenthsIn(json, "min"), tenthsIn(json, "max"), tenthsIn(json, "step"), wholeIn(json, "sections"),
                  json.at("labels").get<std::vector<std::string>>()};
    for (const auto& [key, text] :
         {std::pair{"low", &task.low}, {"high", &task.high}, {"tap", &task.tap}, {"say", &task.say}, {"count", &task.count}})
        *text = json.at(key).get<std::string>();
    if (json.contains("asked")) task.asked = tenthsIn(json, "asked");
    if (json.contains("last")) {
        const auto& last = json.at("last");
        task.last = ScaleFeedback{tenthsIn(last, "shown"), tenthsIn(last, "named"), last.at("is_right").get<bool>(),
                                  last.at("text").get<std::string>()};
    }
    return task;
}

Task taskIn(const nlohmann::json& json, const std::string& where)
{
    const auto name = json.at("task").get<std::string>();
    for (const auto& [task, known] : taskNames)
        if (name == known) return task;
    throw protocols::badInput({"unknown task '" + name + "'", where, "read, consent, facts or scale", ""});
}

Instruction instructionIn(const nlohmann::json& json, const std::string& where)
{
    Instruction instruction;
    instruction.task = taskIn(json, where);
    instruction.title = json.at("title").get<std::string>();
    instruction.lines = json.at("lines").get<std::vector<std::string>>();
    instruction.statement = json.value("statement", "");
    instruction.questions = json.value("questions", std::vector<std::string>());
    if (json.contains("scale")) instruction.scale = scaleTaskIn(json.at("scale"));
    if (json.contains("break_seconds")) instruction.breakSeconds = wholeIn(json, "break_seconds");
    instruction.breakClock = json.value("break_clock", "");
    if ((instruction.task == Task::Scale) != instruction.scale.has_value())
        throw protocols::badInput({"a scale belongs to the task 'scale' only", where, "", ""});
    if (instruction.scale && (instruction.scale->scale.step.value < 1 || instruction.scale->scale.sections < 1 ||
                              instruction.scale->scale.max <= instruction.scale->scale.min))
        throw protocols::badInput({"the scale has no length, step or section", where, "min < max, step > 0, sections > 0", ""});
    return instruction;
}

}  // namespace

bool isSameApartFromTheClock(Instruction a, Instruction b)
{
    if (a.breakSeconds.has_value() != b.breakSeconds.has_value()) return false;
    a.breakSeconds = b.breakSeconds;
    return a == b;
}

std::string jsonOf(const Instruction& instruction)
{
    Json json{{"task", "read"}, {"title", instruction.title}, {"lines", instruction.lines}};
    for (const auto& [task, name] : taskNames)
        if (task == instruction.task) json["task"] = name;
    if (!instruction.statement.empty()) json["statement"] = instruction.statement;
    if (!instruction.questions.empty()) json["questions"] = instruction.questions;
    if (instruction.scale) json["scale"] = jsonOf(*instruction.scale);
    if (instruction.breakSeconds) json["break_seconds"] = *instruction.breakSeconds;
    if (!instruction.breakClock.empty()) json["break_clock"] = instruction.breakClock;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Instruction instructionFromJson(std::string_view text, const std::string& where)
{
    const nlohmann::json json = protocols::parseStrictJson(text, where);
    try {
        return instructionIn(json, where);
    } catch (const nlohmann::json::exception& fault) {
        throw protocols::badInput({"this is no instruction: " + std::string(fault.what()), where, "", ""});
    }
}

}  // namespace study::participant
