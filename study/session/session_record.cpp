// Events as text for the log, and back.
#include <nlohmann/json.hpp>

#include "protocols/errors.h"
#include "study/session/session.h"

namespace study::session {

namespace {

using Json = nlohmann::ordered_json;

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

Json jsonOf(const Response& response)
{
    return std::visit(Overloaded{[](const protocols::FabricId& fabric) {
                                     return Json{{"fabric", fabric.value}};
                                 },
                                 [](const protocols::Tenths& rating) {
                                     return Json{{"tenths", rating.value}};
                                 }},
                      response);
}

Response responseOf(const Json& payload)
{
    if (payload.contains("fabric")) return protocols::FabricId(payload.at("fabric").get<std::string>());
    return protocols::Tenths{payload.at("tenths").get<int>()};
}

Corrected correctedOf(const Json& payload)
{
    return {protocols::QuestionId(payload.at("question").get<std::string>()), responseOf(payload),
            payload.at("why").get<std::string>()};
}

struct Kind {
    const char* name;
    EventBody (*read)(const Json& payload);
};

/// In the order of EventBody's alternatives.
constexpr Kind kinds[] = {
    {"sitting_started", [](const Json&) -> EventBody { return SittingStarted{}; }},
    {"begun", [](const Json&) -> EventBody { return Begun{}; }},
    {"familiarisation_done", [](const Json&) -> EventBody { return FamiliarisationDone{}; }},
    {"scale_training_done", [](const Json&) -> EventBody { return ScaleTrainingDone{}; }},
    {"tray_ready", [](const Json&) -> EventBody { return TrayReady{}; }},
    {"touched", [](const Json&) -> EventBody { return Touched{}; }},
    {"answered", [](const Json& payload) -> EventBody { return Answered{responseOf(payload)}; }},
    {"corrected", [](const Json& payload) -> EventBody { return correctedOf(payload); }},
    {"voided", [](const Json& payload) -> EventBody { return Voided{payload.at("why").get<std::string>()}; }},
    {"break_ended", [](const Json&) -> EventBody { return BreakEnded{}; }},
    {"paused", [](const Json&) -> EventBody { return Paused{}; }},
    {"resumed", [](const Json&) -> EventBody { return Resumed{}; }},
    {"withdrawn", [](const Json& payload) -> EventBody { return WithdrawnEvent{payload.at("why").get<std::string>()}; }},
    {"noted", [](const Json& payload) -> EventBody { return Noted{payload.at("text").get<std::string>()}; }},
};
static_assert(std::size(kinds) == std::variant_size_v<EventBody>);

Json payloadOf(const EventBody& body)
{
    return std::visit(Overloaded{[](const Answered& event) { return jsonOf(event.response); },
                                 [](const Corrected& event) {
                                     Json payload{{"question", event.question.value}};
                                     payload.update(jsonOf(event.response));
                                     payload["why"] = event.why;
                                     return payload;
                                 },
                                 [](const Voided& event) {
                                     return Json{{"why", event.why}};
                                 },
                                 [](const WithdrawnEvent& event) {
                                     return Json{{"why", event.why}};
                                 },
                                 [](const Noted& event) {
                                     return Json{{"text", event.text}};
                                 },
                                 [](const auto&) { return Json::object(); }},
                      body);
}

}  // namespace

std::string kindOf(const EventBody& body) { return kinds[body.index()].name; }

std::string payloadJson(const EventBody& body) { return payloadOf(body).dump(-1, ' ', false, Json::error_handler_t::replace); }

EventBody eventFromRecord(const std::string& kind, const std::string& payloadJson)
{
    try {
        for (const Kind& known : kinds)
            if (kind == known.name) return known.read(Json::parse(payloadJson));
    } catch (const Json::exception& fault) {
        throw protocols::workFailed({"a stored event cannot be read: " + std::string(fault.what()),
                                     "event \"" + kind + "\" " + payloadJson, "", "run vis2hap verify on the study"});
    }
    throw protocols::workFailed(
        {"a stored event is of a kind unknown to this version", "event \"" + kind + "\"", "", "update this program"});
}

std::string nameOf(const State& state)
{
    const std::string stage = std::visit(
        Overloaded{[](const Enrolled&) { return "Enrolled"; }, [](const Familiarising&) { return "Familiarising"; },
                   [](const ScaleTraining&) { return "ScaleTraining"; }, [](const PlacingTray&) { return "PlacingTray"; },
                   [](const Presenting&) { return "Presenting"; }, [](const OnBreak&) { return "OnBreak"; },
                   [](const Finished&) { return "Finished"; }, [](const Withdrawn&) { return "Withdrawn"; }},
        state.stage);
    return state.paused ? stage + " (paused)" : stage;
}

}  // namespace study::session
