#include "study/players/scripted_participant.h"

#include <algorithm>
#include <csignal>
#include <map>

#include "protocols/files/errors.h"
#include "protocols/records/anchor_trials.h"
#include "study/players/player_answers.h"
#include "study/session/preparation.h"
#include "study/session/session_moves.h"
#include "study/session/session_record.h"

namespace study::players {

namespace {

using namespace session;
using What = ScriptedEvent::What;

/// The kind of an event of the script in the log; empty for events that leave no record.
std::string loggedKind(What what)
{
    switch (what) {
        case What::Pause:
            return kindOf(Paused{});
        case What::Resume:
            return kindOf(Resumed{});
        case What::Correct:
            return kindOf(Corrected{});
        case What::Void:
            return kindOf(Voided{});
        case What::Crash:
            return {};  // leaves no record; see skipPassed()
        case What::Note:
            return kindOf(Noted{});
        case What::Withdraw:
            return kindOf(WithdrawnEvent{});
        case What::Touch:
            return kindOf(Touched{});
        case What::Answer:
            return {};  // is always refused
        case What::Expect:
            return {};
    }
    return {};
}

class Player {
public:
    Player(const Script& script, const ScriptedTrials& trials, Hands& hands, VirtualClock& clock)
        : m_script(script), m_trials(trials), m_hands(hands), m_clock(clock), m_passed(script.events.size(), false)
    {
        protocols::AnchorFinder finder(trials.protocol);
        std::vector<std::pair<int, ScriptedPlace>> places;
        for (const auto& trial : trials.trials) {
            const auto& shown = trials.key.entryOf(trial);
            places.push_back(
                {trial.phase,
                 {std::nullopt, shown.condition, shown.fabric, std::nullopt, trial.instruction, finder.next(trial, shown)}});
        }
        const std::vector<Occurrence> occurrences = occurrencesIn(places);
        for (std::size_t i = 0; i < places.size(); ++i) {
            m_places.push_back(places[i].second);
            m_places.back().occurrence = occurrences[i].number;
        }
    }

    void skipPassed(const std::vector<database::EventRecord>& logged);
    void play(const std::function<void(int)>& progress);

private:
    bool performDueEvent();
    void perform(const ScriptedEvent& event);
    void act(const EventBody& event);
    void actInVain(const EventBody& event, const std::string& refusalText);
    void expect(const ScriptedExpectation& expected) const;
    EventBody bodyOf(const ScriptedEvent& event) const;
    Corrected correctionOf(const ScriptedEvent& event) const;
    std::string placeOfEvent() const;
    std::string presentPlace() const;
    void moveOn();
    void answer(const Presenting& presenting);
    GivenAnswer answerFor(const ScriptedResponse& scripted, int index, const protocols::Question& question) const;
    std::string placeName(int index, const protocols::QuestionId& question) const;

    const Script& m_script;
    const ScriptedTrials& m_trials;
    Hands& m_hands;
    VirtualClock& m_clock;
    std::vector<bool> m_passed;
    std::vector<ScriptedPlace> m_places;  ///< [trial]
};

void Player::skipPassed(const std::vector<database::EventRecord>& logged)
{
    std::map<std::pair<std::string, int>, int> happened;
    int stored = 0;
    for (const auto& record : logged) {
        if (record.kind == kindOf(Answered{}))
            ++stored;
        else
            ++happened[{record.kind, stored}];
    }
    for (std::size_t i = 0; i < m_script.events.size(); ++i) {
        const auto& event = m_script.events[i];
        int& left = happened[{event.mustFail ? std::string() : loggedKind(event.what), event.answersStoredBefore}];
        // A session that ended at the place of a crash counts as crashed there, whatever ended it.
        const bool crashed = event.what == What::Crash && !logged.empty() && event.answersStoredBefore == stored;
        m_passed[i] = event.answersStoredBefore < stored || left > 0 || crashed;
        left -= left > 0;
    }
}

std::string Player::placeName(int index, const protocols::QuestionId& question) const
{
    const auto& trial = m_trials.trials[index];
    return m_script.participant.value + ", trial " + std::to_string(trial.number.value) + " (" + trial.presentationCode.value +
           "), " + question.value;
}

std::string Player::placeOfEvent() const
{
    return m_script.where + ", after " + std::to_string(m_hands.state().answersStored) + " answers";
}

/// The script, with the trial and the question at hand if there are any.
std::string Player::presentPlace() const
{
    const auto* presenting = std::get_if<Presenting>(&m_hands.state().stage);
    if (presenting == nullptr) return m_script.where;
    const auto& phase = m_trials.protocol.phases[m_trials.trials[presenting->index].phase];
    const auto question = static_cast<std::size_t>(presenting->question);
    if (question >= phase.questions.size()) return m_script.where;
    return m_script.where + ": " + placeName(presenting->index, phase.questions[question].id);
}

void Player::actInVain(const EventBody& event, const std::string& refusalText)
{
    const auto refusal = m_hands.perform(event);
    if (!refusal)
        throw protocols::workFailed({"\"" + kindOf(event) + "\" was accepted", placeOfEvent(), "a refusal (must_fail)", ""});
    if (refusal->reason.find(refusalText) == std::string::npos)
        throw protocols::workFailed({"\"" + kindOf(event) + "\" was refused with \"" + refusal->reason + "\"", placeOfEvent(),
                                     "\"" + refusalText + "\"", ""});
}

void Player::expect(const ScriptedExpectation& expected) const
{
    const State& state = m_hands.state();
    const auto check = [&](const std::string& what, const std::string& is, const std::string& wanted) {
        if (is != wanted) throw protocols::workFailed({what + " is " + (is.empty() ? "none" : is), placeOfEvent(), wanted, ""});
    };
    const auto* presenting = std::get_if<Presenting>(&state.stage);
    const auto* tray = std::get_if<PlacingTray>(&state.stage);
    const int index = presenting ? presenting->index : tray ? tray->index : -1;
    if (expected.stage) check("the stage", nameOf(state), *expected.stage);
    if (expected.presentation)
        check("the presentation", std::to_string(state.position + 1), std::to_string(*expected.presentation));
    if (expected.trial)
        check("the trial", index < 0 ? "" : std::to_string(m_trials.trials[index].number.value), std::to_string(*expected.trial));
    if (expected.question)
        check("the question",
              presenting ? m_trials.protocol.phases[m_trials.trials[index].phase].questions[presenting->question].id.value : "",
              *expected.question);
}

void Player::act(const EventBody& event)
{
    if (const auto refusal = m_hands.perform(event))
        throw protocols::badInput({"the session refuses \"" + kindOf(event) + "\" after " +
                                       std::to_string(m_hands.state().answersStored) + " answers: " + refusal->reason,
                                   presentPlace(), "a script that the session can follow",
                                   "correct the script; earlier answers are stored"});
}

GivenAnswer Player::answerFor(const ScriptedResponse& scripted, int index, const protocols::Question& question) const
{
    const auto& trial = m_trials.trials[index];
    return scriptedAnswer(
        scripted, question.kind,
        {trial.alternatives, m_trials.key.entryOf(trial).fabric, m_script.where + ": " + placeName(index, question.id)});
}

Corrected Player::correctionOf(const ScriptedEvent& event) const
{
    const auto& answers = m_hands.state().answers;
    for (auto latest = answers.rbegin(); latest != answers.rend(); ++latest) {
        const auto& phase = m_trials.protocol.phases[m_trials.trials[latest->index].phase];
        const auto& question = phase.questions[latest->question];
        if (question.id == event.question)
            return {event.question, answerFor(*event.response, latest->index, question), event.text};
    }
    throw protocols::badInput({"a correction of " + event.question.value + " comes before its answer", m_script.where,
                               "an answer to correct", "correct the script"});
}

EventBody Player::bodyOf(const ScriptedEvent& event) const
{
    switch (event.what) {
        case What::Pause:
            return Paused{};
        case What::Resume:
            return Resumed{};
        case What::Void:
            return Voided{event.text};
        case What::Note:
            return Noted{event.text, event.isFlag};
        case What::Withdraw:
            return WithdrawnEvent{event.text};
        case What::Touch:
            return Touched{};
        case What::Correct:
            return correctionOf(event);
        case What::Answer:
            if (const auto* rating = std::get_if<protocols::Tenths>(&*event.response)) return Answered{*rating};
            return Answered{protocols::FabricId(std::get<std::string>(*event.response))};
        case What::Crash:
        case What::Expect:
            break;
    }
    return Paused{};
}

void Player::perform(const ScriptedEvent& event)
{
    if (event.what == What::Crash)
        std::raise(SIGKILL);
    else if (event.what == What::Expect)
        expect(event.expectation);
    else if (event.mustFail)
        actInVain(bodyOf(event), event.refusal);
    else
        act(bodyOf(event));
}

bool Player::performDueEvent()
{
    const auto& state = m_hands.state();
    for (std::size_t i = 0; i < m_script.events.size(); ++i) {
        const auto& event = m_script.events[i];
        if (m_passed[i] || event.answersStoredBefore != state.answersStored) continue;
        // "Before the answer" means during the presentation. A resume follows its pause immediately.
        if (event.beforeAnswer && !state.paused && !std::holds_alternative<Presenting>(state.stage)) return false;
        m_passed[i] = true;
        perform(event);
        return true;
    }
    return false;
}

/// The stamps of a recorded answer, or those of a script that states one time only.
AnswerStamps stampsOf(const ScriptedAnswer& scripted, std::int64_t readyAtNs, std::int64_t nowNs)
{
    const auto ago = [&](double secondsAfterQuestion) {
        return nowNs - readyAtNs - static_cast<std::int64_t>(std::llround(secondsAfterQuestion * 1e9));
    };
    AnswerStamps stamps{.begunAgoNs = 0, .begunBy = BegunBy::Script, .touchEndedAgoNs = {}, .entries = scripted.entries};
    if (scripted.begunSeconds) {
        stamps.begunAgoNs = ago(*scripted.begunSeconds);
        stamps.begunBy = scripted.begunBySpokenKey ? BegunBy::Spoken : BegunBy::Entry;
    }
    if (scripted.touchEndedSeconds) stamps.touchEndedAgoNs = ago(*scripted.touchEndedSeconds);
    return stamps;
}

void Player::answer(const Presenting& presenting)
{
    const auto& trial = m_trials.trials[presenting.index];
    const auto& question = m_trials.protocol.phases[trial.phase].questions[presenting.question];
    const State& state = m_hands.state();
    ScriptedPlace place = m_places[static_cast<std::size_t>(presenting.index)];
    place.attempt = attemptAt(state, state.position);
    const auto* scripted = m_script.answerTo(question.id, {trial.number, {}, {}, place.attempt});
    if (!scripted) scripted = m_script.answerTo(question.id, place);
    if (!scripted)
        throw protocols::badInput({"no answer", m_script.where + ": " + placeName(presenting.index, question.id),
                                   "an answer to every question and rendering of the protocol",
                                   "add it and run the same command again; earlier answers are stored"});
    const GivenAnswer response = answerFor(scripted->response, presenting.index, question);
    if (scripted->touchSeconds && !presenting.touchedAtNs) {
        m_clock.advanceSeconds(*scripted->touchSeconds);
        act(Touched{scripted->touchedByDisplay ? TouchSource::Display : TouchSource::Operator});
    }
    m_clock.advanceSeconds(scripted->seconds);
    act(Answered{response, stampsOf(*scripted, presenting.readyAtNs, m_clock.monotonicNs())});
}

void Player::moveOn()
{
    const Stage stage = m_hands.state().stage;
    if (m_hands.state().paused) return act(Resumed{});
    if (const auto preparation = nextOfPreparation(m_trials.protocol, stage)) return act(*preparation);
    if (std::holds_alternative<PlacingTray>(stage)) {
        m_clock.advanceSeconds(std::max(2.0, m_trials.protocol.deadTimeSeconds));
        return act(trayReadyOf(m_trials.protocol, m_trials.trials[std::get<PlacingTray>(stage).index].alternatives,
                               m_trials.fabricNames));
    }
    answer(std::get<Presenting>(stage));
}

void Player::play(const std::function<void(int)>& progress)
{
    while (!std::holds_alternative<Finished>(m_hands.state().stage) &&
           !std::holds_alternative<Withdrawn>(m_hands.state().stage)) {
        if (!performDueEvent()) moveOn();
        if (progress) progress(m_hands.state().answersStored);
    }
    while (performDueEvent()) {
    }
}

}  // namespace

void playScript(const Script& script, const ScriptedTrials& trials, const std::vector<database::EventRecord>& logged,
                Hands& hands, session::VirtualClock& clock, const std::function<void(int)>& progress)
{
    Player player(script, trials, hands, clock);
    player.skipPassed(logged);
    player.play(progress);
}

}  // namespace study::players
