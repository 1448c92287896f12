#include "study/session/session_moves.h"

#include <algorithm>
#include <cstdlib>

namespace study::session {

namespace {

int trialAt(const State& state, int position) { return state.order[static_cast<std::size_t>(position)]; }
int phaseIndexAt(const Plan& plan, const State& state, int position)
{
    return plan.trials[static_cast<std::size_t>(trialAt(state, position))].phase;
}

std::string inTenths(int tenths)
{
    const std::string sign = tenths < 0 ? "-" : "";
    const int size = std::abs(tenths);
    return sign + std::to_string(size / 10) + (size % 10 == 0 ? std::string() : "." + std::to_string(size % 10));
}

std::string nameOfFabric(const Plan& plan, const protocols::FabricId& fabric)
{
    const auto name = plan.fabricNames.find(fabric);
    return name == plan.fabricNames.end() ? fabric.value : name->second;
}

std::optional<std::string> faultOfChoice(const Plan& plan, int index, const protocols::FabricId& fabric)
{
    const auto& tray = plan.trials[static_cast<std::size_t>(index)].alternatives;
    if (std::find(tray.begin(), tray.end(), fabric) != tray.end()) return std::nullopt;
    std::string names;
    for (const protocols::FabricId& one : tray) names += (names.empty() ? "" : ", ") + nameOfFabric(plan, one);
    return nameOfFabric(plan, fabric) + " is not on the tray (" + names + ").";
}

std::optional<std::string> faultOfRating(const protocols::Scale& scale, protocols::Tenths rating)
{
    if (scale.holds(rating)) return std::nullopt;
    return inTenths(rating.value) + " is not on the scale: from " + inTenths(scale.min.value) + " to " +
           inTenths(scale.max.value) + " in steps of " + inTenths(scale.step.value) + ".";
}

}  // namespace

const protocols::Phase& phaseOf(const Plan& plan, int index)
{
    return plan.protocol.phases.at(static_cast<std::size_t>(plan.trials.at(static_cast<std::size_t>(index)).phase));
}

int questionsOf(const Plan& plan, int index) { return static_cast<int>(phaseOf(plan, index).questions.size()); }

const protocols::Question& questionOf(const Plan& plan, int index, int question)
{
    return phaseOf(plan, index).questions.at(static_cast<std::size_t>(question));
}

int answersTo(const State& state, int index)
{
    return static_cast<int>(std::count_if(state.answers.begin(), state.answers.end(),
                                          [&](const StoredAnswer& answer) { return answer.index == index; }));
}

std::optional<std::size_t> latestAnswerTo(const Plan& plan, const State& state, const protocols::QuestionId& question)
{
    for (std::size_t place = state.answers.size(); place > 0; --place) {
        const StoredAnswer& answer = state.answers[place - 1];
        if (questionOf(plan, answer.index, answer.question).id == question) return place - 1;
    }
    return std::nullopt;
}

std::optional<protocols::FileCode> fileCodeAt(const Plan& plan, const State& state, int position)
{
    if (position >= static_cast<int>(state.order.size())) return std::nullopt;
    return plan.trials[static_cast<std::size_t>(trialAt(state, position))].fileCode;
}

int donePresentationsOfPhase(const Plan& plan, const State& state, int position)
{
    int first = position;
    while (first > 0 && phaseIndexAt(plan, state, first - 1) == phaseIndexAt(plan, state, position - 1)) --first;
    return position - first;
}

bool breakIsDueBefore(const Plan& plan, const State& state, int position)
{
    if (position <= 0 || position >= static_cast<int>(state.order.size())) return false;
    if (phaseIndexAt(plan, state, position - 1) != phaseIndexAt(plan, state, position)) return true;
    const int count = plan.protocol.breakAfterPresentations;
    return count > 0 && donePresentationsOfPhase(plan, state, position) % count == 0;
}

std::optional<std::string> faultOf(const Plan& plan, int index, int question, const Response& response)
{
    const protocols::Phase& phase = phaseOf(plan, index);
    const std::string& asked = questionOf(plan, index, question).id.value;
    const auto* fabric = std::get_if<protocols::FabricId>(&response);
    if (phase.isChoice() && !fabric) return asked + " asks for one of the fabrics on the tray, not for a number.";
    if (!phase.isChoice() && fabric) return asked + " asks for a number on the scale, not for a fabric.";
    return fabric ? faultOfChoice(plan, index, *fabric)
                  : faultOfRating(phase.scale.value_or(protocols::Scale{}), std::get<protocols::Tenths>(response));
}

std::string refusalOf(const State& state, const EventBody& body)
{
    if (std::holds_alternative<Finished>(state.stage)) return "The session is finished.";
    if (std::holds_alternative<Withdrawn>(state.stage)) return "The participant has withdrawn.";
    if (std::holds_alternative<Answered>(body) || std::holds_alternative<Touched>(body)) return "No question is being asked now.";
    if (std::holds_alternative<Voided>(body)) return "There is no presentation to void yet.";
    return "\"" + kindOf(body) + "\" has no place here (" + nameOf(state) + ").";
}

void interrupt(State& state)
{
    if (const auto* presenting = std::get_if<Presenting>(&state.stage)) state.stage = PlacingTray{presenting->index};
}

void placeTray(const Plan& plan, Step& step)
{
    step.next.stage = PlacingTray{trialAt(step.next, step.next.position)};
    // Read while the tray is filled, so that showing it takes no time then.
    step.effects.emplace_back(Prefetch{*fileCodeAt(plan, step.next, step.next.position)});
}

void endPresentation(const Plan& plan, Step& step)
{
    step.effects.emplace_back(ClearDisplay{});
    const int position = ++step.next.position;
    if (position == static_cast<int>(step.next.order.size()))
        step.next.stage = Finished{};
    else if (breakIsDueBefore(plan, step.next, position))
        step.next.stage = OnBreak{trialAt(step.next, position)};
    else
        placeTray(plan, step);
}

void presentAgain(const Plan& plan, State& state, int index)
{
    std::erase_if(state.answers, [&](const StoredAnswer& answer) { return answer.index == index; });
    const int phase = plan.trials[static_cast<std::size_t>(index)].phase;
    int end = static_cast<int>(state.order.size());
    while (phaseIndexAt(plan, state, end - 1) != phase) --end;
    state.order.insert(state.order.begin() + end, index);
}

}  // namespace study::session
