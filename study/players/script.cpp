#include "study/players/script.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/strict_json.h"

namespace study::players {

namespace {

using nlohmann::json;
using What = ScriptedEvent::What;

constexpr const char* nextStep = "correct the script and run the same command again";

const std::map<std::string, What> eventNames{{"pause", What::Pause},       {"resume", What::Resume}, {"correct", What::Correct},
                                             {"void", What::Void},         {"crash", What::Crash},   {"note", What::Note},
                                             {"withdraw", What::Withdraw}, {"answer", What::Answer}, {"touch", What::Touch},
                                             {"expect", What::Expect}};

/// An object of the script with its place for faults.
class Entry {
public:
    /// `pointer` leads to the object, `name` is what messages call it: "answer 3". Throws badInput where it is no object.
    Entry(const protocols::JsonDocument& document, std::string pointer, std::string name)
        : m_document(document),
          m_object(document.root().at(json::json_pointer(pointer))),
          m_pointer(std::move(pointer)),
          m_name(std::move(name))
    {
        if (!m_object.is_object()) throw fault("", "it is no object", "{...}");
    }

    bool has(const char* field) const { return m_object.contains(field); }

    /// Null where the field is missing.
    const json& operator[](const char* field) const
    {
        static const json nothing;
        const auto found = m_object.find(field);
        return found == m_object.end() ? nothing : *found;
    }

    /// The fault of a field, or of the entry where the field is missing or "".
    protocols::Error fault(const std::string& field, const std::string& what, const std::string& expected) const
    {
        const std::string pointer = field.empty() ? m_pointer : m_pointer + "/" + protocols::pointerStep(field);
        const std::string name = m_name.empty() ? "" : m_name + ": ";
        return m_document.faultAt(pointer, name + what, expected, nextStep);
    }

    std::string text(const char* field) const
    {
        const json& value = (*this)[field];
        if (!value.is_string() || value.get_ref<const std::string&>().empty())
            throw fault(field, std::string("the text \"") + field + "\" is missing", std::string("\"") + field + "\": \"...\"");
        return value.get<std::string>();
    }

    /// A text that may be left out.
    std::string textOrNothing(const char* field) const
    {
        if (!has(field)) return "";
        if (!(*this)[field].is_string())
            throw fault(field, std::string(field) + " is no text", std::string("\"") + field + "\": \"...\"");
        return (*this)[field].get<std::string>();
    }

    int whole(const char* field, int least) const
    {
        const json& value = (*this)[field];
        const bool isInRange = value.is_number_unsigned() ? value.get<std::uint64_t>() <= INT_MAX : value.is_number_integer();
        if (!isInRange || value.get<std::int64_t>() < least || value.get<std::int64_t>() > INT_MAX)
            throw fault(field, std::string(field) + " is not a whole number from " + std::to_string(least),
                        std::string("\"") + field + "\": N");
        return value.get<int>();
    }

    /// False where the field is missing.
    bool yes(const char* field) const
    {
        if (has(field) && !(*this)[field].is_boolean())
            throw fault(field, std::string(field) + " is neither true nor false", "true or false");
        return has(field) && (*this)[field].get<bool>();
    }

    /// A time in seconds by which the clock can advance.
    double seconds(const char* field, double least) const
    {
        const json& value = (*this)[field];
        const double seconds = value.is_number() ? value.get<double>() : -1;
        if (!(seconds >= least && seconds < 86400))
            throw fault(field, std::string(field) + " is out of range", "a number above 0 and below a day");
        return seconds;
    }

private:
    const protocols::JsonDocument& m_document;
    const json& m_object;
    std::string m_pointer, m_name;
};

ScriptedResponse responseIn(const Entry& entry)
{
    if (!entry.has("answer")) throw entry.fault("", "the answer is missing", "\"answer\": ...");
    const json& value = entry["answer"];
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number())
        throw entry.fault("answer", "the answer is neither text nor a number", "correct, foil:1, a fabric id, or a rating");
    const double tenths = value.get<double>() * 10;
    if (!(std::abs(tenths) <= 1e6) || std::abs(tenths - std::round(tenths)) > 1e-6)
        throw entry.fault("answer", "rating " + value.dump() + " is not a whole number of tenths", "a rating like 5.4");
    return protocols::Tenths{static_cast<int>(std::lround(tenths))};
}

/// A condition of the program, one of the study's own, or "catch". An answer to a condition that the study does not show is never
/// used, so scripts of a larger study fit.
protocols::ConditionId conditionIn(const Entry& entry, const protocols::Protocol& protocol)
{
    const std::string text = entry.text("condition");
    const protocols::ConditionId id(text);
    if (id == protocols::catchTrialId() || isOwnCondition(protocol, id)) return id;
    const auto unknown = protocols::faultOf(text);
    if (!unknown) return protocols::conditionIdFrom(text);
    std::string known;
    for (const protocols::ConditionId& one : protocol.conditions) known += (known.empty() ? "" : ", ") + one.value;
    throw entry.fault("condition", unknown->what, "a condition of the study: " + known);
}

ScriptedPlace placeFrom(const Entry& entry, const protocols::Protocol& protocol)
{
    ScriptedPlace place;
    if (entry.has("attempt")) place.attempt = entry.whole("attempt", 1);
    if (entry.has("trial")) {
        place.trial = protocols::TrialNumber{entry.whole("trial", 1)};
        return place;
    }
    if (entry.has("instruction")) place.instruction = protocols::InstructionId(entry.text("instruction"));
    if (entry.has("anchor")) {
        const auto kind = protocols::anchorKindNamed(entry.text("anchor"));
        if (!kind)
            throw entry.fault("anchor", "unknown anchor \"" + entry.text("anchor") + "\"", "\"mismatched\" or \"repeated\"");
        place.anchor = *kind;
    }
    if (entry.has("occurrence")) place.occurrence = entry.whole("occurrence", 1);
    place.fabric = protocols::FabricId(entry.text("fabric"));
    place.condition = conditionIn(entry, protocol);
    return place;
}

ScriptedAnswer answerFrom(const Entry& entry, const protocols::Protocol& protocol)
{
    ScriptedAnswer answer;
    answer.question = protocols::QuestionId(entry.text("question"));
    answer.place = placeFrom(entry, protocol);
    answer.response = responseIn(entry);
    answer.seconds = entry.has("seconds") ? entry.seconds("seconds", 1e-9) : 1.0;
    if (entry.has("touch_seconds")) answer.touchSeconds = entry.seconds("touch_seconds", 0);
    const std::string toucher = entry.textOrNothing("touched_by");
    if (entry.has("touched_by") && toucher != "display" && toucher != "operator")
        throw entry.fault("touched_by", "unknown touched_by \"" + toucher + "\"", "\"display\" or \"operator\"");
    answer.touchedByDisplay = toucher == "display";
    if (entry.has("begun_seconds")) answer.begunSeconds = entry.seconds("begun_seconds", 0);
    const std::string beginner = entry.textOrNothing("begun_by");
    if (entry.has("begun_by") && beginner != "entry" && beginner != "spoken")
        throw entry.fault("begun_by", "unknown begun_by \"" + beginner + "\"", "\"entry\" or \"spoken\"");
    answer.begunBySpokenKey = beginner == "spoken";
    if (entry.has("touch_ended_seconds")) answer.touchEndedSeconds = entry.seconds("touch_ended_seconds", 0);
    if (entry.has("entries")) answer.entries = entry.whole("entries", 2);
    return answer;
}

/// The fields of an expectation. Each is optional.
ScriptedExpectation expectationFrom(const Entry& entry)
{
    ScriptedExpectation expectation;
    for (const auto& [field, target] : {std::pair{"stage", &expectation.stage}, {"question", &expectation.question}})
        if (entry.has(field)) *target = entry.text(field);
    for (const auto& [field, target] : {std::pair{"presentation", &expectation.presentation}, {"trial", &expectation.trial}})
        if (entry.has(field)) *target = entry.whole(field, 0);
    return expectation;
}

ScriptedEvent::What whatIn(const Entry& entry)
{
    const auto name = eventNames.find(entry.text("do"));
    if (name == eventNames.end())
        throw entry.fault("do", "unknown event \"" + entry.text("do") + "\"",
                          "pause, resume, correct, void, crash, note, withdraw, answer, touch or expect");
    return name->second;
}

ScriptedEvent eventFrom(const Entry& entry)
{
    ScriptedEvent event;
    event.what = whatIn(entry);
    event.beforeAnswer = entry.has("before_answer");
    if (!event.beforeAnswer && !entry.has("after_answer"))
        throw entry.fault("", "the event has no place", "before_answer or after_answer: N, counted from 1");
    event.answersStoredBefore = event.beforeAnswer ? entry.whole("before_answer", 1) - 1 : entry.whole("after_answer", 0);
    if (event.what == What::Correct) event.question = protocols::QuestionId(entry.text("question"));
    if (event.what == What::Correct || event.what == What::Answer) event.response = responseIn(entry);
    if (event.what == What::Expect) event.expectation = expectationFrom(entry);
    event.isFlag = entry.yes("flag");
    event.mustFail = entry.yes("must_fail");
    if (event.what == What::Answer && !event.mustFail)
        throw entry.fault("", "an answer among the events must have \"must_fail\"",
                          "\"must_fail\": true; other answers stand under \"answers\"");
    event.refusal = entry.textOrNothing("refusal");
    event.text = entry.textOrNothing(event.what == What::Note ? "text" : "why");
    return event;
}

protocols::Error fault(const std::string& what, const std::string& where, const std::string& expected)
{
    return protocols::badInput({what, where, expected, nextStep});
}

/// Whether the phase of the question gives the instruction that the answer names.
bool isInstructed(const protocols::Protocol& protocol, const ScriptedAnswer& answer)
{
    return std::ranges::any_of(protocol.phases, [&](const protocols::Phase& phase) {
        return std::ranges::any_of(phase.questions, [&](const auto& asked) { return asked.id == answer.question; }) &&
               instructionWith(phase.instructions, answer.place.instruction) != nullptr;
    });
}

void checkQuestions(const Script& script, const protocols::Protocol& protocol)
{
    std::set<protocols::QuestionId> known;
    for (const auto& phase : protocol.phases)
        for (const auto& question : phase.questions) known.insert(question.id);
    for (const auto& answer : script.answers)
        if (!known.contains(answer.question))
            throw fault("the protocol has no question " + answer.question.value, script.where, "the questions of the protocol");
    for (const auto& answer : script.answers)
        if (!answer.place.instruction.empty() && !isInstructed(protocol, answer))
            throw fault(
                "the answers to " + answer.question.value + " have no instruction \"" + answer.place.instruction.value + "\"",
                script.where, "an instruction of the question's phase in the protocol");
}

void checkDoubled(const Script& script)
{
    std::set<std::tuple<protocols::QuestionId, ScriptedPlace>> seen;
    for (const auto& answer : script.answers) {
        if (seen.emplace(answer.question, answer.place).second) continue;
        const std::string place =
            answer.place.trial ? "trial " + std::to_string(answer.place.trial->value)
                               : answer.place.condition.value + ", " + answer.place.fabric.value +
                                     (answer.place.instruction.empty() ? "" : ", ") + answer.place.instruction.value +
                                     (nameOf(answer.place.anchor).empty() ? "" : ", ") + nameOf(answer.place.anchor) +
                                     (answer.place.occurrence ? ", occurrence " + std::to_string(*answer.place.occurrence) : "");
        throw fault("there are two answers to " + answer.question.value + " for " + place, script.where,
                    "one answer for each question and rendering");
    }
}

}  // namespace

std::vector<Occurrence> occurrencesIn(const std::vector<std::pair<int, ScriptedPlace>>& places)
{
    std::map<std::pair<int, ScriptedPlace>, int> counts;
    std::vector<Occurrence> occurrences;
    for (const auto& place : places) occurrences.push_back({++counts[place], false});
    for (std::size_t i = 0; i < places.size(); ++i) occurrences[i].isShared = counts[places[i]] > 1;
    return occurrences;
}

const ScriptedAnswer* Script::answerTo(const protocols::QuestionId& question, const ScriptedPlace& place) const
{
    const auto find = [&](const ScriptedPlace& one) {
        const auto found = std::find_if(answers.begin(), answers.end(), [&](const ScriptedAnswer& answer) {
            return answer.question == question && answer.place == one;
        });
        return found == answers.end() ? nullptr : &*found;
    };
    std::vector<ScriptedPlace> wanted{place};
    const auto add = [&](auto forget) {
        for (std::size_t i = 0, known = wanted.size(); i < known; ++i) {
            ScriptedPlace wider = wanted[i];
            forget(wider);
            wanted.push_back(wider);
        }
    };
    add([](ScriptedPlace& wider) { wider.attempt.reset(); });
    add([](ScriptedPlace& wider) { wider.occurrence.reset(); });
    if (!place.instruction.empty()) add([](ScriptedPlace& wider) { wider.instruction = {}; });
    if (place.anchor == protocols::AnchorKind::Repeated)
        add([](ScriptedPlace& wider) { wider.anchor = protocols::AnchorKind::None; });
    for (const ScriptedPlace& one : wanted)
        if (const auto* found = find(one)) return found;
    return nullptr;
}

bool Script::withdraws() const
{
    return std::ranges::any_of(events, [](const ScriptedEvent& event) { return event.what == ScriptedEvent::What::Withdraw; });
}

Script scriptFromJson(std::string_view text, const std::string& where, const protocols::Protocol& protocol)
{
    const protocols::JsonDocument document(text, where);
    const Entry root(document, "", "");
    if (root["schema"] != "vis2hap.script/1")
        throw root.fault("schema", "the file is not a script of this program", "\"schema\": \"vis2hap.script/1\"");
    Script script;
    script.where = where;
    script.participant = protocols::ParticipantId(root.text("participant"));
    protocols::requireGoodId(script.participant.value, "a participant", where + ", " + document.placeOf("/participant"));
    if (root.has("slot")) script.slot = root.whole("slot", 1);
    if (!root["answers"].is_array()) throw root.fault("answers", "the list of answers is missing", "\"answers\": [...]");
    if (root.has("events") && !root["events"].is_array())
        throw root.fault("events", "the events are no list", "\"events\": [...]");
    for (std::size_t i = 0; i < root["answers"].size(); ++i)
        script.answers.push_back(
            answerFrom({document, "/answers/" + std::to_string(i), "answer " + std::to_string(i + 1)}, protocol));
    for (std::size_t i = 0; i < root["events"].size(); ++i)
        script.events.push_back(eventFrom({document, "/events/" + std::to_string(i), "event " + std::to_string(i + 1)}));
    checkQuestions(script, protocol);
    checkDoubled(script);
    return script;
}

}  // namespace study::players
