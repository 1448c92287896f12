#include "study/session/session_record.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/json_count.h"

namespace study::session {

namespace {

using Json = nlohmann::ordered_json;
using protocols::Overloaded;

Corrected correctedOf(const Json& payload)
{
    return {protocols::QuestionId(payload.at("question").get<std::string>()), givenAnswerIn(payload),
            payload.at("why").get<std::string>()};
}

EnteredBy enteredByIn(const Json& payload)
{
    return payload.value("by", "operator") == "participant" ? EnteredBy::Participant : EnteredBy::Operator;
}

/// The operator is not named: earlier versions had nobody else.
Json withEnteredBy(Json payload, EnteredBy by)
{
    if (by == EnteredBy::Participant) payload["by"] = "participant";
    return payload;
}

/// Which facts were given; what they are is kept where it can be erased.
FactsGiven factsOf(const Json& payload)
{
    FactsGiven given;
    for (const Json& fact : payload.at("given")) given.facts[fact.get<std::string>()];
    given.by = enteredByIn(payload);
    return given;
}

ChecklistDone checklistOf(const Json& payload)
{
    return {payload.at("ticked").get<std::vector<std::string>>(),
            payload.at("readings").get<std::map<std::string, std::string>>()};
}

Touched touchOf(const Json& payload)
{
    return {payload.value("by", "operator") == "display" ? TouchSource::Display : TouchSource::Operator,
            protocols::wholeIn(payload, "ago_ns", std::int64_t{0})};
}

constexpr std::pair<BegunBy, const char*> begunByNames[] = {
    {BegunBy::Entry, "entry"}, {BegunBy::Spoken, "spoken"}, {BegunBy::Script, "script"}};

AnswerStamps stampsIn(const Json& payload)
{
    AnswerStamps stamps;
    if (payload.contains("begun_ago_ns")) stamps.begunAgoNs = protocols::wholeOf<std::int64_t>(payload.at("begun_ago_ns"));
    const std::string begunBy = payload.value("begun_by", "entry");
    for (const auto& [by, name] : begunByNames)
        if (begunBy == name) stamps.begunBy = by;
    if (payload.contains("touch_ended_ago_ns"))
        stamps.touchEndedAgoNs = protocols::wholeOf<std::int64_t>(payload.at("touch_ended_ago_ns"));
    if (payload.contains("entries")) stamps.entries = protocols::wholeOf<int>(payload.at("entries"));
    return stamps;
}

void addStampsTo(Json& payload, const AnswerStamps& stamps)
{
    if (stamps.begunAgoNs) {
        payload["begun_ago_ns"] = *stamps.begunAgoNs;
        payload["begun_by"] = nameOf(stamps.begunBy);
    }
    if (stamps.touchEndedAgoNs) payload["touch_ended_ago_ns"] = *stamps.touchEndedAgoNs;
    if (stamps.entries) payload["entries"] = *stamps.entries;
}

struct Kind {
    const char* name;
    EventBody (*read)(const Json& payload);
};

/// In the order of EventBody's alternatives.
constexpr Kind kinds[] = {
    {"sitting_started",
     [](const Json& payload) -> EventBody {
         return SittingStarted{protocols::wholeIn(payload, "dead_time_ns", std::int64_t{0})};
     }},
    {"begun", [](const Json&) -> EventBody { return Begun{}; }},
    {"consented", [](const Json& payload) -> EventBody { return Consented{enteredByIn(payload)}; }},
    {"facts_given", [](const Json& payload) -> EventBody { return factsOf(payload); }},
    {"familiarisation_shown",
     [](const Json& payload) -> EventBody { return FamiliarisationShown{protocols::wholeOf<int>(payload.at("item"))}; }},
    {"familiarisation_done", [](const Json&) -> EventBody { return FamiliarisationDone{}; }},
    {"scale_placed",
     [](const Json& payload) -> EventBody {
         return ScalePlaced{{protocols::wholeOf<int>(payload.at("shown"))},
                            {protocols::wholeOf<int>(payload.at("spoken"))},
                            enteredByIn(payload)};
     }},
    {"scale_training_done", [](const Json&) -> EventBody { return ScaleTrainingDone{}; }},
    {"checklist_done", [](const Json& payload) -> EventBody { return checklistOf(payload); }},
    {"sitting_prepared", [](const Json&) -> EventBody { return SittingPrepared{}; }},
    {"tray_ready",
     [](const Json& payload) -> EventBody { return TrayReady{payload.value("pieces", std::vector<std::string>())}; }},
    {"touched", [](const Json& payload) -> EventBody { return touchOf(payload); }},
    {"answered",
     [](const Json& payload) -> EventBody {
         return Answered{givenAnswerIn(payload), stampsIn(payload)};
     }},
    {"corrected", [](const Json& payload) -> EventBody { return correctedOf(payload); }},
    {"voided", [](const Json& payload) -> EventBody { return Voided{payload.at("why").get<std::string>()}; }},
    {"break_ended", [](const Json&) -> EventBody { return BreakEnded{}; }},
    {"paused", [](const Json&) -> EventBody { return Paused{}; }},
    {"resumed", [](const Json&) -> EventBody { return Resumed{}; }},
    {"withdrawn", [](const Json& payload) -> EventBody { return WithdrawnEvent{payload.at("why").get<std::string>()}; }},
    {"noted",
     [](const Json& payload) -> EventBody {
         return Noted{payload.at("text").get<std::string>(), payload.value("flag", false)};
     }},
    {"debriefed", [](const Json&) -> EventBody { return Debriefed{}; }},
};
static_assert(std::size(kinds) == std::variant_size_v<EventBody>);

Json payloadOfEvent(const EventBody& body)
{
    return std::visit(
        Overloaded{[](const Answered& event) {
                       Json payload = payloadOf(event.response);
                       addStampsTo(payload, event.stamps);
                       return payload;
                   },
                   [](const TrayReady& event) {
                       return event.pieces.empty() ? Json::object() : Json{{"pieces", event.pieces}};
                   },
                   [](const SittingStarted& event) {
                       return event.deadTimeNs == 0 ? Json::object() : Json{{"dead_time_ns", event.deadTimeNs}};
                   },
                   [](const Corrected& event) {
                       Json payload{{"question", event.question.value}};
                       payload.update(payloadOf(event.response));
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
                       return event.isFlag ? Json{{"text", event.text}, {"flag", true}} : Json{{"text", event.text}};
                   },
                   [](const Consented& event) { return withEnteredBy(Json::object(), event.by); },
                   [](const FactsGiven& event) {
                       Json given = Json::array();
                       for (const auto& [fact, value] : event.facts) given.push_back(fact);
                       return withEnteredBy({{"given", given}}, event.by);
                   },
                   [](const FamiliarisationShown& event) {
                       return Json{{"item", event.item}};
                   },
                   [](const ScalePlaced& event) {
                       return withEnteredBy({{"shown", event.shown.value}, {"spoken", event.spoken.value}}, event.by);
                   },
                   [](const ChecklistDone& event) {
                       return Json{{"ticked", event.ticked}, {"readings", event.readings}};
                   },
                   [](const Touched& event) {
                       Json payload{{"by", event.by == TouchSource::Display ? "display" : "operator"}};
                       if (event.agoNs != 0) payload["ago_ns"] = event.agoNs;
                       return payload;
                   },
                   [](const auto&) { return Json::object(); }},
        body);
}

void addOperator(Json& payload, const EventBody& body, const OperatedBy& operatedBy)
{
    const bool isStart = std::holds_alternative<SittingStarted>(body);
    const bool changesAnswers = std::holds_alternative<Corrected>(body) || std::holds_alternative<Voided>(body);
    OperatedBy nobody;
    nobody.display = operatedBy.display;  // The display alone says nothing about who runs the sitting.
    if (operatedBy == nobody || (!isStart && !changesAnswers)) return;
    payload["operator"] = operatedBy.operatorName;
    if (!isStart) return;
    payload["program"] = operatedBy.program;
    payload["host"] = operatedBy.host;
    if (!operatedBy.display.empty()) payload["display"] = operatedBy.display;
    if (operatedBy.plainImages) payload["plain_images"] = true;
}

}  // namespace

std::string nameOf(BegunBy by)
{
    for (const auto& [known, name] : begunByNames)
        if (known == by) return name;
    return {};
}

std::string kindOf(const EventBody& body) { return kinds[body.index()].name; }

std::string payloadJson(const EventBody& body, const OperatedBy& operatedBy)
{
    Json payload = payloadOfEvent(body);
    addOperator(payload, body, operatedBy);
    return payload.dump(-1, ' ', false, Json::error_handler_t::replace);
}

EventBody eventFromRecord(const std::string& kind, const std::string& payloadJson)
{
    const Json payload = protocols::storedOrderedJson(payloadJson);
    if (payload.is_discarded())
        throw protocols::workFailed({"a stored event cannot be read", "event \"" + kind + "\" " + payloadJson,
                                     "a payload in JSON, not nested deeply", "run vis2hap verify on the study"});
    try {
        for (const Kind& known : kinds)
            if (kind == known.name) return known.read(payload);
    } catch (const Json::exception& fault) {
        throw protocols::workFailed({"a stored event cannot be read: " + std::string(fault.what()),
                                     "event \"" + kind + "\" " + payloadJson, "", "run vis2hap verify on the study"});
    }
    throw protocols::workFailed(
        {"a stored event is of a kind unknown to this version", "event \"" + kind + "\"", "", "update this program"});
}

}  // namespace study::session
