#include "study/players/script.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "protocols/condition.h"
#include "protocols/files/errors.h"

namespace study::players {

namespace {

using nlohmann::json;
using What = ScriptedEvent::What;

const std::map<std::string, What> eventNames{{"pause", What::Pause},       {"resume", What::Resume}, {"correct", What::Correct},
                                             {"void", What::Void},         {"crash", What::Crash},   {"note", What::Note},
                                             {"withdraw", What::Withdraw}, {"answer", What::Answer}, {"touch", What::Touch},
                                             {"expect", What::Expect}};

protocols::Error fault(const std::string& what, const std::string& where, const std::string& expected)
{
    return protocols::badInput({what, where, expected, "mend the script and run the same command again"});
}

std::string textField(const json& entry, const char* field, const std::string& where)
{
    if (!entry.contains(field) || !entry[field].is_string())
        throw fault(std::string("no text \"") + field + "\"", where, std::string("\"") + field + "\": \"...\"");
    return entry[field].get<std::string>();
}

ScriptedResponse responseFrom(const json& value, const std::string& where)
{
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number())
        throw fault("an answer that is neither text nor a number", where, "correct, foil:1, a fabric id, or a rating");
    const double tenths = value.get<double>() * 10;
    if (std::abs(tenths) > 1e6 || std::abs(tenths - std::round(tenths)) > 1e-6)
        throw fault("rating " + value.dump() + " is not a whole number of tenths", where, "a rating like 5.4");
    return protocols::Tenths{static_cast<int>(std::lround(tenths))};
}

ScriptedPlace placeFrom(const json& entry, const std::string& where)
{
    ScriptedPlace place;
    if (entry.contains("attempt")) {
        if (!entry["attempt"].is_number_integer() || entry["attempt"].get<int>() < 1)
            throw fault("attempt is no whole number from 1", where, "\"attempt\": N");
        place.attempt = entry["attempt"].get<int>();
    }
    if (entry.contains("trial")) {
        if (!entry["trial"].is_number_integer()) throw fault("trial is no whole number", where, "\"trial\": N, from 1");
        place.trial = protocols::TrialNumber{entry["trial"].get<int>()};
        return place;
    }
    place.fabric = protocols::FabricId(textField(entry, "fabric", where));
    if (entry.value("condition", json()) == protocols::catchTrialId().value) {
        place.condition = protocols::catchTrialId();
        return place;
    }
    try {
        place.condition = protocols::conditionNamed(textField(entry, "condition", where)).conditionId();
    } catch (const protocols::Error& unknown) {
        throw fault(unknown.what(), where, "");
    }
    return place;
}

/// Seconds that a clock can go on by.
double secondsIn(const json& entry, const char* field, double least, const std::string& where)
{
    const double seconds = entry[field].is_number() ? entry[field].get<double>() : -1;
    if (!(seconds >= least && seconds < 86400))
        throw fault(std::string(field) + " out of range", where, "a number above 0 and below a day");
    return seconds;
}

ScriptedAnswer answerFrom(const json& entry, const std::string& where)
{
    ScriptedAnswer answer;
    answer.question = protocols::QuestionId(textField(entry, "question", where));
    answer.place = placeFrom(entry, where);
    if (!entry.contains("answer")) throw fault("no answer", where, "\"answer\": ...");
    answer.response = responseFrom(entry["answer"], where);
    answer.seconds = entry.contains("seconds") ? secondsIn(entry, "seconds", 1e-9, where) : 1.0;
    if (entry.contains("touch_seconds")) answer.touchSeconds = secondsIn(entry, "touch_seconds", 0, where);
    answer.touchedByDisplay = entry.value("touched_by", json()) == "display";
    return answer;
}

/// The fields of an expectation, each optional and of its kind.
ScriptedExpectation expectationFrom(const json& entry, const std::string& where)
{
    ScriptedExpectation expectation;
    for (const auto& [field, target] : {std::pair{"stage", &expectation.stage}, {"question", &expectation.question}})
        if (entry.contains(field)) *target = textField(entry, field, where);
    for (const auto& [field, target] : {std::pair{"presentation", &expectation.presentation}, {"trial", &expectation.trial}})
        if (entry.contains(field)) {
            if (!entry[field].is_number_integer())
                throw fault(std::string(field) + " is no whole number", where, std::string("\"") + field + "\": N");
            *target = entry[field].get<int>();
        }
    return expectation;
}

ScriptedEvent eventFrom(const json& entry, const std::string& where)
{
    ScriptedEvent event;
    const auto name = eventNames.find(textField(entry, "do", where));
    if (name == eventNames.end())
        throw fault("unknown event \"" + entry["do"].get<std::string>() + "\"", where,
                    "pause, resume, correct, void, crash, note, withdraw, answer, touch or expect");
    event.what = name->second;
    event.beforeAnswer = entry.contains("before_answer");
    const char* count = event.beforeAnswer ? "before_answer" : "after_answer";
    if (!entry.contains(count) || !entry[count].is_number_integer() || entry[count].get<int>() < (event.beforeAnswer ? 1 : 0))
        throw fault("an event without its place", where, "before_answer or after_answer: N, counted from 1");
    event.answersStoredBefore = entry[count].get<int>() - (event.beforeAnswer ? 1 : 0);
    if (event.what == What::Correct) event.question = protocols::QuestionId(textField(entry, "question", where));
    if (event.what == What::Correct || event.what == What::Answer) {
        if (!entry.contains("answer")) throw fault("an event without its answer", where, "\"answer\": ...");
        event.response = responseFrom(entry["answer"], where);
    }
    if (event.what == What::Expect) event.expectation = expectationFrom(entry, where);
    event.isFlag = entry.value("flag", json()) == true;
    event.mustFail = entry.value("must_fail", json()) == true;
    if (event.what == What::Answer && !event.mustFail)
        throw fault("an answer among the events that need not fail", where,
                    "\"must_fail\": true; answers stand under \"answers\"");
    if (entry.contains("refusal")) event.refusal = textField(entry, "refusal", where);
    event.text = entry.value(event.what == What::Note ? "text" : "why", std::string());
    return event;
}

void checkQuestions(const Script& script, const protocols::Protocol& protocol)
{
    std::set<protocols::QuestionId> known;
    for (const auto& phase : protocol.phases)
        for (const auto& question : phase.questions) known.insert(question.id);
    for (const auto& answer : script.answers)
        if (!known.contains(answer.question))
            throw fault("the protocol asks no question " + answer.question.value, script.where, "the questions of the protocol");
}

void checkDoubled(const Script& script)
{
    std::set<std::tuple<protocols::QuestionId, ScriptedPlace>> seen;
    for (const auto& answer : script.answers) {
        if (seen.emplace(answer.question, answer.place).second) continue;
        const std::string place = answer.place.trial ? "trial " + std::to_string(answer.place.trial->value)
                                                     : answer.place.condition.value + ", " + answer.place.fabric.value;
        throw fault("doubled answer to " + answer.question.value + " for " + place, script.where,
                    "one answer for each question and rendering");
    }
}

}  // namespace

const ScriptedAnswer* Script::answerTo(const protocols::QuestionId& question, const ScriptedPlace& place) const
{
    const auto find = [&](const ScriptedPlace& wanted) {
        const auto found = std::find_if(answers.begin(), answers.end(), [&](const ScriptedAnswer& answer) {
            return answer.question == question && answer.place == wanted;
        });
        return found == answers.end() ? nullptr : &*found;
    };
    if (const auto* ofAttempt = find(place)) return ofAttempt;
    ScriptedPlace ofAny = place;
    ofAny.attempt.reset();
    return find(ofAny);
}

Script scriptFromJson(std::string_view text, const std::string& where, const protocols::Protocol& protocol)
{
    json root;
    try {
        root = json::parse(text);
    } catch (const json::exception& problem) {
        throw fault(std::string("no JSON (") + problem.what() + ")", where, "a script as the README describes it");
    }
    if (!root.is_object() || root.value("schema", "") != "vis2hap.script/1")
        throw fault("no script of this program", where, "\"schema\": \"vis2hap.script/1\"");
    Script script;
    script.where = where;
    script.participant = protocols::ParticipantId(textField(root, "participant", where));
    if (script.participant.empty()) throw fault("an empty participant id", where, "\"participant\": \"S01\"");
    if (!root.contains("answers") || !root["answers"].is_array()) throw fault("no list of answers", where, "\"answers\": [...]");
    for (std::size_t i = 0; i < root["answers"].size(); ++i)
        script.answers.push_back(answerFrom(root["answers"][i], where + ", answer " + std::to_string(i + 1)));
    if (root.contains("events"))
        for (std::size_t i = 0; i < root["events"].size(); ++i)
            script.events.push_back(eventFrom(root["events"][i], where + ", event " + std::to_string(i + 1)));
    checkQuestions(script, protocol);
    checkDoubled(script);
    return script;
}

}  // namespace study::players
