#include <algorithm>
#include <cstdlib>

#include "study/session/driver.h"
#include "study/session/session_moves.h"

namespace study::session {

namespace {

std::string nameOfPhase(const protocols::Phase& phase)
{
    const std::string& first = phase.questions.front().id.value;
    return phase.questions.size() == 1 ? first : first + "-" + phase.questions.back().id.value;
}

std::string spoken(const Plan& plan, const Response& response)
{
    if (const auto* rating = std::get_if<protocols::Tenths>(&response))
        return (rating->value < 0 ? "-" : "") + std::to_string(std::abs(rating->value) / 10) + "." +
               std::to_string(std::abs(rating->value) % 10);
    const auto& fabric = std::get<protocols::FabricId>(response);
    const auto name = plan.fabricNames.find(fabric);
    return name == plan.fabricNames.end() ? fabric.value : name->second;
}

void addTrial(View& view, const Plan& plan, int index, int question)
{
    const protocols::BlindedTrial& trial = plan.trials[static_cast<std::size_t>(index)];
    view.code = trial.presentationCode;
    view.trayIds = trial.alternatives;
    for (const protocols::FabricId& fabric : trial.alternatives) view.tray.push_back(spoken(plan, fabric));
    view.question = questionOf(plan, index, question);
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
    for (const int index : state.order) answers += questionsOf(plan, index);
    return answers;
}

/// Presentations from the present one on, until the session stops for a break or its end.
int presentationsToBreak(const Plan& plan, const State& state)
{
    const int end = static_cast<int>(state.order.size());
    int next = state.position;
    while (next < end && (next == state.position || !breakIsDueBefore(plan, state, next))) ++next;
    return next - state.position;
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
        view.phaseName = nameOfPhase(phaseOf(m_plan, m_state.order[static_cast<std::size_t>(m_state.position)]));
    if (const auto* tray = std::get_if<PlacingTray>(&m_state.stage))
        addTrial(view, m_plan, tray->index, answersTo(m_state, tray->index));
    if (const auto* presenting = std::get_if<Presenting>(&m_state.stage))
        addTrial(view, m_plan, presenting->index, presenting->question);
    view.presentation = std::min(m_state.position + 1, count);
    view.presentations = count;
    view.answersStored = m_state.answersStored;
    view.answersInAll = answersInAll(m_plan, m_state);
    view.minutesLeft = remaining * m_plan.protocol.secondsPerPresentation / 60;
    view.presentationsToBreak = remaining == 0 ? 0 : presentationsToBreak(m_plan, m_state);
    addLastAnswer(view, m_plan, m_state);
    return view;
}

}  // namespace study::session
