#include "study/players/session_script.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "study/players/player_answers.h"
#include "study/session/driver.h"
#include "study/session/session_moves.h"
#include "study/session/session_record.h"

namespace study::players {

namespace {

using namespace session;
using nlohmann::ordered_json;

constexpr const char* scriptSchema = "vis2hap.script/1";

std::string scriptNameOf(const protocols::ParticipantId& participant)
{
    return protocols::fileNameOf(participant.value) + ".json";
}

/// Participants whose answers were erased.
std::set<protocols::ParticipantId> erasedIn(const database::StudyStore& store)
{
    std::set<protocols::ParticipantId> erased;
    for (const auto& erasure : store.erasures())
        if (erasure.answersToo) erased.insert(erasure.participant);
    return erased;
}

ordered_json jsonOf(const GivenAnswer& answer)
{
    return std::visit(protocols::Overloaded{[](const std::string& text) { return ordered_json(text); },
                                            [](const protocols::Tenths& rating) { return ordered_json(rating.inScaleUnits()); }},
                      scriptedFormOf(answer));
}

/// Follows one log through the session and writes the script that repeats it.
class Recorder {
public:
    Recorder(const Plan& plan, const protocols::ParticipantId& participant, const records::Naming* naming, ordered_json& script,
             bool hasVoids)
        : m_plan(plan), m_participant(participant), m_naming(naming), m_script(script), m_hasVoids(hasVoids)
    {
        if (m_naming == nullptr) return;
        std::vector<std::pair<int, ScriptedPlace>> places;
        for (const auto& trial : plan.trials) {
            const auto& shown = naming->of(participant, trial.number);
            places.push_back({trial.phase,
                              {std::nullopt, protocols::ConditionId(shown.condition), shown.fabric, std::nullopt,
                               trial.instruction, shown.anchor}});
        }
        m_occurrences = occurrencesIn(places);
    }

    void follow(const database::EventRecord& record)
    {
        const EventBody body = eventFromRecord(record.kind, record.payloadJson);
        const bool isAsked = std::holds_alternative<Presenting>(m_state.stage) || !std::holds_alternative<Answered>(body);
        if (!isAsked || !isStamp(record.atNs))
            throw protocols::workFailed(
                {"the stored log is inconsistent",
                 m_participant.value + ", event " + std::to_string(record.sequence) + " (" + record.kind + ")",
                 "events in the order of a session", "run vis2hap verify on the study"});
        write(body, record.atNs);
        auto outcome = apply(m_plan, m_state, {body, record.atNs, EventSource::Log});
        if (auto* step = std::get_if<SessionStep>(&outcome)) m_state = std::move(step->next);
    }

private:
    void write(const EventBody& body, std::int64_t atNs)
    {
        if (const auto* answered = std::get_if<Answered>(&body))
            m_script["answers"].push_back(answer(std::get<Presenting>(m_state.stage), *answered, atNs));
        else if (const auto* corrected = std::get_if<Corrected>(&body))
            add({{"do", "correct"},
                 {"question", corrected->question.value},
                 {"answer", jsonOf(corrected->response)},
                 {"why", corrected->why}},
                false);
        else if (const auto* voided = std::get_if<Voided>(&body))
            add({{"do", "void"}, {"why", voided->why}}, true);
        else if (const auto* noted = std::get_if<Noted>(&body))
            add(noted->isFlag ? ordered_json{{"do", "note"}, {"text", noted->text}, {"flag", true}}
                              : ordered_json{{"do", "note"}, {"text", noted->text}},
                true);
        else if (std::holds_alternative<Paused>(body))
            add({{"do", "pause"}}, true);
        else if (std::holds_alternative<Resumed>(body))
            add({{"do", "resume"}}, false);
        else if (const auto* withdrawn = std::get_if<WithdrawnEvent>(&body))
            add({{"do", "withdraw"}, {"why", withdrawn->why}}, true);
    }

    /// `orDuring`: during a presentation the event belongs before the next answer, else right after the last one.
    void add(const ordered_json& what, bool orDuring)
    {
        const bool isAsking = orDuring && std::holds_alternative<Presenting>(m_state.stage);
        ordered_json event{{isAsking ? "before_answer" : "after_answer", m_state.answersStored + int(isAsking)}};
        event.update(what);
        m_script["events"].push_back(event);
    }

    ordered_json answer(const Presenting& asked, const Answered& answered, std::int64_t atNs) const
    {
        const auto& trial = m_plan.trials[static_cast<std::size_t>(asked.index)];
        ordered_json entry{{"question", questionOf(m_plan, asked.index, asked.question).id.value}};
        if (!m_naming)
            entry["trial"] = trial.number.value;
        else {
            const auto& shown = m_naming->of(m_participant, trial.number);
            entry["condition"] = shown.condition;
            entry["fabric"] = shown.fabric.value;
            if (!trial.instruction.empty()) entry["instruction"] = trial.instruction.value;
            if (shown.anchor != protocols::AnchorKind::None) entry["anchor"] = nameOf(shown.anchor);
            if (const auto& one = m_occurrences[static_cast<std::size_t>(asked.index)]; one.isShared)
                entry["occurrence"] = one.number;
        }
        if (m_hasVoids) entry["attempt"] = attemptAt(m_state, m_state.position);
        entry["answer"] = jsonOf(answered.response);
        const std::int64_t from = asked.touchedAtNs.value_or(asked.readyAtNs);
        entry["seconds"] = std::max<double>(1e-9, static_cast<double>(atNs - from) / 1e9);
        if (asked.touchedAtNs) {
            entry["touch_seconds"] = static_cast<double>(*asked.touchedAtNs - asked.readyAtNs) / 1e9;
            if (asked.touchedBy == TouchSource::Display) entry["touched_by"] = "display";
        }
        addStamps(entry, asked, answered.stamps, atNs);
        return entry;
    }

    /// A script states its own time, so only stamps of people are written.
    static void addStamps(ordered_json& entry, const Presenting& asked, const AnswerStamps& stamps, std::int64_t atNs)
    {
        const auto afterQuestion = [&](std::int64_t ago) {
            return static_cast<double>(stampOf(atNs, ago, asked.readyAtNs) - asked.readyAtNs) / 1e9;
        };
        if (stamps.begunAgoNs && stamps.begunBy != BegunBy::Script) {
            entry["begun_seconds"] = std::max(0.0, afterQuestion(*stamps.begunAgoNs));
            entry["begun_by"] = nameOf(stamps.begunBy);
        }
        if (stamps.touchEndedAgoNs) entry["touch_ended_seconds"] = std::max(0.0, afterQuestion(*stamps.touchEndedAgoNs));
        if (stamps.entries) entry["entries"] = *stamps.entries;
    }

    const Plan& m_plan;
    const protocols::ParticipantId& m_participant;
    const records::Naming* m_naming;  ///< null while the study is blinded
    ordered_json& m_script;
    bool m_hasVoids;
    std::vector<Occurrence> m_occurrences;  ///< [trial]; empty while the study is blinded
    State m_state;
};

}  // namespace

std::vector<std::string> scriptsOfErased(const database::StudyStore& store, const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    for (const auto& participant : erasedIn(store)) {
        const std::string name = scriptNameOf(participant);
        const auto script = nlohmann::json::parse(protocols::readIfPossible(folder / name).value_or(""), nullptr, false);
        const bool isScript = script.is_object() && script.value("schema", nlohmann::json()) == scriptSchema;
        if (isScript && script.value("participant", nlohmann::json()) == participant.value) names.push_back(name);
    }
    return names;
}

void writeScripts(const database::StudyStore& store, const records::Naming* naming, const std::filesystem::path& out)
{
    const auto erased = erasedIn(store);
    for (const auto& enrolment : store.enrolments()) {
        if (erased.contains(enrolment.participant)) continue;
        ordered_json script{{"schema", scriptSchema},
                            {"participant", enrolment.participant.value},
                            {"slot", enrolment.slot},
                            {"answers", ordered_json::array()},
                            {"events", ordered_json::array()}};
        const auto log = store.events(enrolment.participant);
        const bool hasVoids =
            std::any_of(log.begin(), log.end(), [](const auto& record) { return record.kind == kindOf(Voided{}); });
        const Plan plan = readPlan(store, enrolment.participant);
        Recorder recorder(plan, enrolment.participant, naming, script, hasVoids);
        for (const auto& record : log) recorder.follow(record);
        const auto file = out / scriptNameOf(enrolment.participant);
        if (std::filesystem::exists(file))
            throw protocols::environmentFault({"the file system takes the names of two scripts for one", file.string(),
                                               "a folder that tells capital letters from small ones",
                                               "export into a folder on another disk"});
        protocols::writeWholeFile(file, script.dump(1) + "\n", protocols::Sync::Later);
    }
}

}  // namespace study::players
