#include "study/session/view.h"

#include <algorithm>

#include "study/session/session_moves.h"

namespace study::session {

namespace {

constexpr std::size_t enoughToKnowThePace = 5;

std::string nameOfPhase(const protocols::Phase& phase)
{
    const std::string& first = phase.questions.front().id.value;
    return phase.questions.size() == 1 ? first : first + "-" + phase.questions.back().id.value;
}

bool isWhole(protocols::Tenths number) { return number.value % 10 == 0; }

bool hasWholeNumbersOnly(const protocols::AnswerKind& kind)
{
    const auto* rating = std::get_if<protocols::Rating>(&kind);
    return rating && isWhole(rating->scale.min) && isWhole(rating->scale.max) && isWhole(rating->scale.step);
}

/// As it is read back: "linen", "5.0", or "5" where the scale has whole numbers only.
std::string spoken(const Plan& plan, const protocols::Question& question, const GivenAnswer& answer)
{
    if (const auto* fabric = std::get_if<protocols::FabricId>(&answer)) return nameIn(plan.fabricNames, *fabric);
    const auto* rating = std::get_if<protocols::Tenths>(&answer);
    if (rating && isWhole(*rating) && hasWholeNumbersOnly(question.kind)) return std::to_string(rating->value / 10);
    return textOf(answer);
}

void addTrial(View& view, const Plan& plan, const State& state, int index, int question)
{
    const protocols::BlindedTrial& trial = plan.trials[static_cast<std::size_t>(index)];
    view.code = codeOfAttempt(plan.trials, static_cast<std::size_t>(index), attemptAt(state, state.position));
    view.trayIds = trial.alternatives;
    for (const protocols::FabricId& fabric : trial.alternatives) view.tray.push_back(nameIn(plan.fabricNames, fabric));
    view.question = questionOf(plan, index, question);
}

/// Whether the operator still has other questions to explain before the presentation at hand or next.
bool beginsPhase(const Plan& plan, const State& state)
{
    return phaseBeginsAt(plan, state, state.position) &&
           answersTo(state, state.order[static_cast<std::size_t>(state.position)].index) == 0;
}

/// Instruction of the presentation at hand or next.
void addInstruction(View& view, const Plan& plan, const State& state)
{
    if (state.position >= static_cast<int>(state.order.size())) return;
    const auto* instruction = instructionOf(plan, state.order[static_cast<std::size_t>(state.position)].index);
    if (!instruction) return;
    view.instruction = *instruction;
    const bool isAfterRest = state.trayAskedAtNs == state.restedAtNs || state.trayAskedAtNs == state.preparedAtNs;
    view.instructionBegins = state.position == 0 || blockEndsBefore(state, state.position) || isAfterRest;
}

void addLastAnswer(View& view, const Plan& plan, const State& state)
{
    if (state.answers.empty()) return;
    const StoredAnswer& last = state.answers.back();
    const protocols::Question& question = questionOf(plan, last.index, last.question);
    view.lastQuestion = question.id;
    view.lastAnswer = question.id.value + ": " + spoken(plan, question, last.response);
}

std::size_t nextIndex(const State& state)
{
    return static_cast<std::size_t>(state.order[static_cast<std::size_t>(state.position) + 1].index);
}

/// Answers stored so far and those to come. A presentation that was voided before an answer adds none.
int answersInAll(const Plan& plan, const State& state)
{
    std::vector<int> given(plan.trials.size(), 0);
    for (const StoredAnswer& answer : state.answers) ++given[static_cast<std::size_t>(answer.index)];
    int answers = state.answersStored;
    for (std::size_t at = static_cast<std::size_t>(state.position); at < state.order.size(); ++at)
        answers += questionsOf(plan, state.order[at].index) - given[static_cast<std::size_t>(state.order[at].index)];
    return answers;
}

/// Number of presentations from the present one to the next break or the end.
int presentationsToBreak(const State& state)
{
    const int end = static_cast<int>(state.order.size());
    int next = state.position;
    while (next < end && (next == state.position || !blockEndsBefore(state, next))) ++next;
    return next - state.position;
}

double median(std::vector<double> values)
{
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.size() % 2 == 1 ? *middle : (*middle + *std::max_element(values.begin(), middle)) / 2;
}

/// Seconds of the presentations of a phase: from the tray on, for each piece that changes on a tray, for a tray where none does.
struct PhasePace {
    double perPresentation = 0, perPiece = 0, unchangedTray = 0;
};

/// Medians of this session, or the protocol's value for the first presentations.
PhasePace paceOf(const Plan& plan, const State& state, int phase)
{
    std::vector<double> answers, perPiece, unchanged;
    for (const Pace& done : state.pace) {
        if (done.phase != phase) continue;
        answers.push_back(static_cast<double>(done.answersNs) / 1e9);
        (done.pieces > 0 ? perPiece : unchanged).push_back(static_cast<double>(done.trayNs) / 1e9 / std::max(1, done.pieces));
    }
    if (answers.size() < enoughToKnowThePace) return {plan.protocol.secondsPerPresentation, 0, 0};
    return {median(std::move(answers)), median(std::move(perPiece)), median(std::move(unchanged))};
}

double minutesLeft(const Plan& plan, const State& state)
{
    std::vector<PhasePace> paces;
    for (std::size_t phase = 0; phase < plan.protocol.phases.size(); ++phase)
        paces.push_back(paceOf(plan, state, static_cast<int>(phase)));
    double seconds = 0;
    for (int at = state.position; at < static_cast<int>(state.order.size()); ++at) {
        const int index = state.order[static_cast<std::size_t>(at)].index;
        const PhasePace& pace = paces[static_cast<std::size_t>(plan.trials[static_cast<std::size_t>(index)].phase)];
        const int pieces = piecesToLay(plan, state, at);
        seconds += pace.perPresentation + (pieces > 0 ? pace.perPiece * pieces : pace.unchangedTray);
    }
    return seconds / 60;
}

}  // namespace

View viewOf(const Plan& plan, const State& state, const protocols::ParticipantId& participant, std::int64_t nowNs)
{
    View view;
    view.state = state;
    view.participant = participant.value;
    const int count = static_cast<int>(state.order.size());
    const int remaining = std::holds_alternative<Withdrawn>(state.stage) ? 0 : count - state.position;
    if (state.position < count)
        view.phaseName = nameOfPhase(phaseOf(plan, state.order[static_cast<std::size_t>(state.position)].index));
    view.phaseBegins = beginsPhase(plan, state);
    if (const auto* tray = std::get_if<PlacingTray>(&state.stage))
        addTrial(view, plan, state, tray->index, answersTo(state, tray->index));
    if (const auto* presenting = std::get_if<Presenting>(&state.stage)) {
        addTrial(view, plan, state, presenting->index, presenting->question);
        if (state.position + 1 < count)
            for (const protocols::FabricId& fabric : plan.trials[nextIndex(state)].alternatives)
                view.nextTray.push_back(nameIn(plan.fabricNames, fabric));
    }
    view.presentation = std::min(state.position + 1, count);
    view.presentations = count;
    view.answersStored = state.answersStored;
    view.answersInAll = answersInAll(plan, state);
    view.minutesLeft = remaining == 0 ? 0 : minutesLeft(plan, state);
    view.sittingMinutes = static_cast<double>(nowNs - state.sittingBeganAtNs) / 6e10;
    view.presentationsToBreak = remaining == 0 ? 0 : presentationsToBreak(state);
    view.sittingIsPrepared = state.preparedSitting == 0 || state.preparedSitting == state.sitting;
    for (const FamiliarisationImage& item : plan.familiarisation) view.familiarisation.push_back(item.name);
    view.placeToName = placeToName(plan, state);
    if (std::holds_alternative<OnBreak>(state.stage)) view.breakSeconds = static_cast<double>(nowNs - state.breakBeganAtNs) / 1e9;
    addInstruction(view, plan, state);
    addLastAnswer(view, plan, state);
    return view;
}

}  // namespace study::session
