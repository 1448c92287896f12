#include "study/session/session_moves.h"

#include <algorithm>
#include <cstdlib>

#include "protocols/random.h"
#include "study/session/session_record.h"

namespace study::session {

namespace {

const PlaceInOrder& placeAt(const State& state, int position) { return state.order[static_cast<std::size_t>(position)]; }

int phaseIndexAt(const Plan& plan, const State& state, int position)
{
    return plan.trials[static_cast<std::size_t>(placeAt(state, position).index)].phase;
}

constexpr std::int64_t minuteNs = 60LL * 1000 * 1000 * 1000;
constexpr std::int64_t farthestStampNs = std::int64_t{1} << 61;

std::optional<BreakReason> breakDueBefore(const Plan& plan, const State& state, int position, std::int64_t atNs)
{
    const bool sittingIsLong = atNs - state.sittingBeganAtNs >= plan.protocol.sittingMinutes * minuteNs;
    if (sittingIsLong && !state.sittingOverTold) return BreakReason::SittingOver;
    if (phaseBeginsAt(plan, state, position)) return BreakReason::Phase;
    if (blockEndsBefore(state, position)) return BreakReason::Block;
    if (plan.protocol.breakAfterMinutes && atNs - state.restedAtNs >= *plan.protocol.breakAfterMinutes * minuteNs)
        return BreakReason::Time;
    return std::nullopt;
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

const protocols::BlockInstruction* instructionOf(const Plan& plan, int index)
{
    return instructionWith(phaseOf(plan, index).instructions, plan.trials.at(static_cast<std::size_t>(index)).instruction);
}

std::vector<PlaceInOrder> orderOf(const Plan& plan)
{
    std::vector<PlaceInOrder> order;
    int block = 0, inBlock = 0;
    for (std::size_t i = 0; i < plan.trials.size(); ++i) {
        // A change of the instruction is a break, so that the operator can say the new one. Protocol::breaks() has the same rule.
        const bool isNewList = i > 0 && (plan.trials[i].phase != plan.trials[i - 1].phase ||
                                         plan.trials[i].instruction != plan.trials[i - 1].instruction);
        if (isNewList || inBlock == plan.protocol.breakAfterPresentations) {
            ++block;
            inBlock = 0;
        }
        ++inBlock;
        order.push_back({static_cast<int>(i), block});
    }
    return order;
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

std::optional<protocols::SealedCode> sealedCodeAt(const Plan& plan, const State& state, int position)
{
    if (position >= static_cast<int>(state.order.size())) return std::nullopt;
    const protocols::SealedCode& code = plan.trials[static_cast<std::size_t>(placeAt(state, position).index)].sealedCode;
    return code.empty() ? std::nullopt : std::optional(code);
}

int attemptAt(const State& state, int position)
{
    const int index = placeAt(state, position).index;
    return static_cast<int>(std::count_if(state.order.begin(), state.order.begin() + position + 1,
                                          [&](const PlaceInOrder& place) { return place.index == index; }));
}

int attemptSoFar(const State& state, int index)
{
    const auto end = std::min<std::ptrdiff_t>(state.position + 1, static_cast<std::ptrdiff_t>(state.order.size()));
    return static_cast<int>(std::count_if(state.order.begin(), state.order.begin() + end,
                                          [&](const PlaceInOrder& place) { return place.index == index; }));
}

std::optional<PresentationMeant> presentationMeant(const State& state)
{
    const auto presentedAt = [&](int position) {
        return PresentationMeant{placeAt(state, position).index, attemptAt(state, position)};
    };
    if (state.order.empty()) return std::nullopt;
    const bool isOver = state.position == static_cast<int>(state.order.size());
    const bool hasBegun = !isOver && (std::holds_alternative<Presenting>(state.stage) ||
                                      answersTo(state, placeAt(state, state.position).index) > 0);
    if (hasBegun) return presentedAt(state.position);
    if (state.position == 0) return std::nullopt;
    return presentedAt(state.position - 1);
}

bool phaseBeginsAt(const Plan& plan, const State& state, int position)
{
    if (position <= 0 || position >= static_cast<int>(state.order.size())) return false;
    return phaseIndexAt(plan, state, position - 1) != phaseIndexAt(plan, state, position);
}

bool blockEndsBefore(const State& state, int position)
{
    if (position <= 0 || position >= static_cast<int>(state.order.size())) return false;
    return placeAt(state, position - 1).block != placeAt(state, position).block;
}

int placesInARow(const ScaleTraining& training) { return training.isRefresher ? 1 : 3; }

std::optional<protocols::Tenths> placeToName(const Plan& plan, const State& state)
{
    const auto* training = std::get_if<ScaleTraining>(&state.stage);
    const protocols::RatingScale* scale = memorisedScaleOf(plan.protocol);
    if (!training || !scale || plan.trials.empty() || training->rightInARow >= placesInARow(*training)) return std::nullopt;
    const int round = training->placed / 3;
    // The first round has no number: earlier versions had one round only, and their logs hold its places.
    protocols::Random random = protocols::Random::stream(
        static_cast<std::uint64_t>(state.sitting),
        "places on the scale/" + plan.trials.front().presentationCode.value + (round == 0 ? "" : "/" + std::to_string(round)));
    const int steps = (scale->max.value - scale->min.value) / scale->step.value;
    std::vector<protocols::Tenths> places;
    for (int third = 0; third < 3; ++third) {
        const int from = steps * third / 3 + 1, to = std::max(from + 1, steps * (third + 1) / 3);
        const int step = from + static_cast<int>(random.below(static_cast<std::uint64_t>(to - from)));
        places.push_back({scale->min.value + scale->step.value * std::min(step, steps)});
    }
    random.shuffle(places);
    return places[static_cast<std::size_t>(training->placed % 3)];
}

bool isStamp(std::int64_t atNs) { return atNs > -farthestStampNs && atNs < farthestStampNs; }

std::int64_t stampOf(std::int64_t atNs, std::int64_t agoNs, std::int64_t earliestNs)
{
    const std::int64_t age = std::clamp<std::int64_t>(agoNs, 0, farthestStampNs);
    return std::max(earliestNs, atNs - age);
}

bool isRightPlace(const protocols::RatingScale& scale, protocols::Tenths shown, protocols::Tenths named)
{
    // The log of an altered study may hold any number.
    const std::int64_t distance = std::abs(std::int64_t{named.value} - shown.value);
    return distance * 20 <= std::int64_t{scale.max.value} - scale.min.value;
}

std::optional<std::string> faultOfAnswer(const Plan& plan, int index, int question, const GivenAnswer& answer)
{
    const auto& tray = plan.trials.at(static_cast<std::size_t>(index)).alternatives;
    return faultOf(answer, questionOf(plan, index, question), tray, plan.fabricNames);
}

std::optional<std::string> faultOfPieces(const Plan& plan, int index, const std::vector<std::string>& pieces)
{
    const auto& tray = plan.trials.at(static_cast<std::size_t>(index)).alternatives;
    for (std::size_t slot = 0; slot < tray.size(); ++slot) {
        const std::string letter(1, static_cast<char>('A' + static_cast<char>(slot % 26)));
        const std::string needed = nameIn(plan.fabricNames, tray[slot]);
        if (slot >= pieces.size()) return "The piece in slot " + letter + " is not confirmed. It must be " + needed + ".";
        if (pieces[slot] != needed) return "Slot " + letter + " holds " + pieces[slot] + ". It must be " + needed + ".";
    }
    if (pieces.size() > tray.size()) return "More pieces were confirmed than the tray has slots.";
    return std::nullopt;
}

std::string refusalOf(const State& state, const EventBody& body)
{
    if (std::holds_alternative<Finished>(state.stage)) return "The session is finished.";
    if (std::holds_alternative<Withdrawn>(state.stage)) return "The participant has withdrawn.";
    if (std::holds_alternative<Answered>(body) || std::holds_alternative<Touched>(body)) return "No question is being asked now.";
    if (std::holds_alternative<Voided>(body)) return "There is no presentation to void yet.";
    return "\"" + kindOf(body) + "\" is not possible now (" + nameOf(state) + ").";
}

void interrupt(State& state)
{
    state.trayTookNs = 0;
    if (const auto* presenting = std::get_if<Presenting>(&state.stage)) state.stage = PlacingTray{presenting->index};
    if (auto* familiarising = std::get_if<Familiarising>(&state.stage)) familiarising->shown.reset();
}

void prepareOn(const Plan& plan, SessionStep& step, std::int64_t atNs)
{
    const std::size_t stage = step.next.stage.index();
    const auto comesAfter = [&](const Stage& later) { return later.index() > stage; };
    if (comesAfter(Consenting{}) && !plan.protocol.consent.empty())
        step.next.stage = Consenting{};
    else if (comesAfter(AskingFacts{}) && !plan.protocol.facts.empty())
        step.next.stage = AskingFacts{};
    else if (comesAfter(Familiarising{}))
        step.next.stage = Familiarising{};
    else if (comesAfter(ScaleTraining{}) && memorisedScaleOf(plan.protocol))
        step.next.stage = ScaleTraining{};
    else if (comesAfter(CheckingList{}) && !(plan.protocol.checklist.empty() && plan.protocol.readings.empty()))
        step.next.stage = CheckingList{};
    else {
        step.next.preparedSitting = step.next.sitting;
        step.next.preparedAtNs = atNs;
        placeTray(plan, step, atNs);
    }
}

void placeTray(const Plan& plan, SessionStep& step, std::int64_t atNs)
{
    step.next.stage = PlacingTray{placeAt(step.next, step.next.position).index};
    step.next.trayAskedAtNs = atNs;
    step.next.trayTookNs = 0;
    // Read the image while the operator fills the tray, so that it can be shown at once.
    if (const auto code = sealedCodeAt(plan, step.next, step.next.position)) step.effects.emplace_back(Prefetch{*code});
}

void endPresentation(const Plan& plan, SessionStep& step, std::int64_t atNs)
{
    State& next = step.next;
    step.effects.emplace_back(ClearDisplay{});
    next.pace.push_back({phaseIndexAt(plan, next, next.position), next.trayTookNs, atNs - next.trayAskedAtNs - next.trayTookNs,
                         piecesToLay(plan, next, next.position)});
    const int position = ++next.position;
    if (position == static_cast<int>(next.order.size())) {
        next.stage = Debriefing{};
    } else if (const auto reason = breakDueBefore(plan, next, position, atNs)) {
        next.sittingOverTold = next.sittingOverTold || *reason == BreakReason::SittingOver;
        next.stage = OnBreak{placeAt(next, position).index, *reason};
        next.breakBeganAtNs = atNs;
    } else {
        placeTray(plan, step, atNs);
    }
}

int piecesToLay(const Plan& plan, const State& state, int position)
{
    const auto trayAt = [&](int place) -> const std::vector<protocols::FabricId>& {
        return plan.trials[static_cast<std::size_t>(placeAt(state, place).index)].alternatives;
    };
    const auto& tray = trayAt(position);
    if (position == 0) return static_cast<int>(tray.size());
    const auto& before = trayAt(position - 1);
    int pieces = 0;
    for (std::size_t slot = 0; slot < tray.size(); ++slot) pieces += slot >= before.size() || tray[slot] != before[slot];
    return pieces;
}

void presentAgain(const Plan& plan, State& state, int index, int fromPosition)
{
    std::erase_if(state.answers, [&](const StoredAnswer& answer) { return answer.index == index; });
    const int size = static_cast<int>(state.order.size()), phase = phaseIndexAt(plan, state, fromPosition);
    const int next = fromPosition + 1;
    // If its block has ended, the next block takes the trial, provided that it has the same phase and instruction.
    const bool blockIsOver = fromPosition < state.position && blockEndsBefore(state, next) &&
                             phaseIndexAt(plan, state, next) == phase &&
                             plan.trials[static_cast<std::size_t>(placeAt(state, next).index)].instruction ==
                                 plan.trials[static_cast<std::size_t>(index)].instruction;
    const int block = placeAt(state, blockIsOver ? next : fromPosition).block;
    int end = next;
    while (end < size && placeAt(state, end).block == block && phaseIndexAt(plan, state, end) == phase) ++end;
    state.order.insert(state.order.begin() + end, {index, block});
}

}  // namespace study::session
