#include <algorithm>
#include <cstdlib>

#include "study/session/driver.h"
#include "study/session/session_moves.h"

namespace study::session {

namespace {

constexpr std::size_t enoughToKnowThePace = 5;

std::string nameOfPhase(const protocols::Phase& phase)
{
    const std::string& first = phase.questions.front().id.value;
    return phase.questions.size() == 1 ? first : first + "-" + phase.questions.back().id.value;
}

std::string spoken(const Plan& plan, const Response& response)
{
    const auto* fabric = std::get_if<protocols::FabricId>(&response);
    if (!fabric) return textOf(response);
    const auto name = plan.fabricNames.find(*fabric);
    return name == plan.fabricNames.end() ? fabric->value : name->second;
}

void addTrial(View& view, const Plan& plan, const State& state, int index, int question)
{
    const protocols::BlindedTrial& trial = plan.trials[static_cast<std::size_t>(index)];
    view.code = codeOfAttempt(plan.trials, static_cast<std::size_t>(index), attemptAt(state, state.position));
    view.trayIds = trial.alternatives;
    for (const protocols::FabricId& fabric : trial.alternatives) view.tray.push_back(spoken(plan, fabric));
    view.question = questionOf(plan, index, question);
    view.answerKind = answerKindOf(phaseOf(plan, index), *view.question);
    view.scale = phaseOf(plan, index).scale;
}

void addLastAnswer(View& view, const Plan& plan, const State& state)
{
    if (state.answers.empty()) return;
    const StoredAnswer& last = state.answers.back();
    view.lastQuestion = questionOf(plan, last.index, last.question).id;
    view.lastAnswer = view.lastQuestion->value + ": " + spoken(plan, last.response);
}

int answersInAll(const Plan& plan, const State& state)
{
    int answers = 0;
    for (const Place& place : state.order) answers += questionsOf(plan, place.index);
    return answers;
}

/// Presentations from the present one on, until the session stops for a break or its end.
int presentationsToBreak(const State& state)
{
    const int end = static_cast<int>(state.order.size());
    int next = state.position;
    while (next < end && (next == state.position || !blockEndsBefore(state, next))) ++next;
    return next - state.position;
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Seconds a presentation of this phase takes: this participant's median, once it is known.
double paceOf(const Plan& plan, const State& state, int phase)
{
    std::vector<double> seconds;
    for (const auto& [done, ns] : state.paceNs)
        if (done == phase) seconds.push_back(static_cast<double>(ns) / 1e9);
    return seconds.size() < enoughToKnowThePace ? plan.protocol.secondsPerPresentation : median(std::move(seconds));
}

double minutesLeft(const Plan& plan, const State& state)
{
    std::vector<int> left(plan.protocol.phases.size());
    for (std::size_t at = static_cast<std::size_t>(state.position); at < state.order.size(); ++at)
        ++left[static_cast<std::size_t>(plan.trials[static_cast<std::size_t>(state.order[at].index)].phase)];
    double seconds = 0;
    for (std::size_t phase = 0; phase < left.size(); ++phase)
        if (left[phase] > 0) seconds += left[phase] * paceOf(plan, state, static_cast<int>(phase));
    return seconds / 60;
}

}  // namespace

View Driver::view() const
{
    View view;
    view.state = m_state;
    view.participant = m_participant.value;
    const int count = static_cast<int>(m_state.order.size());
    const int remaining = std::holds_alternative<Withdrawn>(m_state.stage) ? 0 : count - m_state.position;
    if (m_state.position < count)
        view.phaseName = nameOfPhase(phaseOf(m_plan, m_state.order[static_cast<std::size_t>(m_state.position)].index));
    if (const auto* tray = std::get_if<PlacingTray>(&m_state.stage))
        addTrial(view, m_plan, m_state, tray->index, answersTo(m_state, tray->index));
    if (const auto* presenting = std::get_if<Presenting>(&m_state.stage))
        addTrial(view, m_plan, m_state, presenting->index, presenting->question);
    view.presentation = std::min(m_state.position + 1, count);
    view.presentations = count;
    view.answersStored = m_state.answersStored;
    view.answersInAll = answersInAll(m_plan, m_state);
    view.minutesLeft = remaining == 0 ? 0 : minutesLeft(m_plan, m_state);
    view.sittingMinutes = static_cast<double>(m_clock.monotonicNs() - m_state.sittingBeganAtNs) / 6e10;
    view.presentationsToBreak = remaining == 0 ? 0 : presentationsToBreak(m_state);
    view.sittingIsPrepared = m_state.preparedSitting == 0 || m_state.preparedSitting == m_state.sitting;
    for (const FamiliarisationItem& item : m_plan.familiarisation) view.familiarisation.push_back(item.name);
    view.placesToName = placesToName(m_plan, m_state);
    addLastAnswer(view, m_plan, m_state);
    return view;
}

}  // namespace study::session
