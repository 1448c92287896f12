// The transition table. Rows: stages; columns: events; an empty cell is refused with a reason.
//
//                 | Begun | Famil. | ScaleT.| Tray  | Touched | Answered  | Void | Break | Pause | Resume
//                 |       | Done   | Done   | Ready |         |           |      | Ended |       |
// ----------------+-------+--------+--------+-------+---------+-----------+------+-------+-------+-------
// Enrolled        | Famil.|        |        |       |         |           |      |       | +p    |
// Familiarising   |       | ScaleT.|        |       |         |           |      |       | +p    |
// ScaleTraining   |       |        | Tray   |       |         |           |      |       | +p    |
// PlacingTray i   |       |        |        | Pres. |         |           | (a)  |       | +p    |
// Presenting i q  |       |        |        |       | Pres.   | Pres. q+1 | next |       | Tray i|
//                 |       |        |        |       |         | or next   |      |       | +p    |
// OnBreak         |       |        |        |       |         |           | (a)  | Tray  | +p    |
// Finished        |       |        |        |       |         |           |      |       |       |
// Withdrawn       |       |        |        |       |         |           |      |       |       |
// any, paused     |       |        |        |       |         |           |      |       |       | -p
//
// next = after the last question or a void: OnBreak when the phase ends or breakAfterPresentations are
//        done in it, PlacingTray of the next presentation, Finished after the last.
// (a)  = voids the presentation just completed (or the interrupted one, where it has answers already)
//        and stays; the tray may then be another one.
// In every cell of their columns, so not drawn: SittingStarted (Presenting i -> PlacingTray i; the pause
// stays), Noted, WithdrawnEvent (not twice) -> Withdrawn, Corrected (not once withdrawn, and only where
// there is an answer to correct).
//
// Kept in every state: `order` holds each trial once and once more for each void, phases together;
// Presenting and PlacingTray are of trial order[position]; `answers` holds no two answers to the same
// question of the same trial and none of a voided presentation.
#include <numeric>

#include "study/session/session_moves.h"

namespace study::session {

namespace {

using Outcome = std::variant<Step, Refusal>;

/// What one event does in one stage; the general template is the empty cell of the table.
struct Transition {
    const Plan& plan;
    const State& state;
    std::int64_t atNs;

    template <class Stage, class Body>
    Outcome operator()(const Stage&, const Body& body) const
    {
        return Refusal{refusalOf(state, body)};
    }

    Outcome operator()(const Enrolled&, const Begun&) const { return moved(Familiarising{}); }
    Outcome operator()(const Familiarising&, const FamiliarisationDone&) const { return moved(ScaleTraining{}); }
    Outcome operator()(const ScaleTraining&, const ScaleTrainingDone&) const { return placing(); }
    Outcome operator()(const OnBreak&, const BreakEnded&) const { return placing(); }

    Outcome operator()(const PlacingTray& tray, const TrayReady&) const
    {
        Step step = moved(Presenting{tray.index, answersTo(state, tray.index), atNs, std::nullopt});
        step.effects.emplace_back(ShowStimulus{plan.trials[static_cast<std::size_t>(tray.index)].fileCode});
        if (const auto next = fileCodeAt(plan, state, state.position + 1)) step.effects.emplace_back(Prefetch{*next});
        return step;
    }

    Outcome operator()(const Presenting& presenting, const Touched&) const
    {
        if (presenting.touchedAtNs) return Refusal{"The first touch is stamped already."};
        Presenting touched = presenting;
        touched.touchedAtNs = atNs;
        return moved(touched);
    }

    Outcome operator()(const Presenting& presenting, const Answered& answered) const
    {
        if (const auto fault = faultOf(plan, presenting.index, presenting.question, answered.response)) return Refusal{*fault};
        Step step{state, {}};
        step.next.answers.push_back({presenting.index, presenting.question, answered.response});
        ++step.next.answersStored;
        if (presenting.question + 1 < questionsOf(plan, presenting.index))
            step.next.stage = Presenting{presenting.index, presenting.question + 1, atNs, std::nullopt};
        else
            endPresentation(plan, step);
        return step;
    }

    Outcome operator()(const Presenting& presenting, const Voided&) const
    {
        Step step{state, {}};
        presentAgain(plan, step.next, presenting.index);
        endPresentation(plan, step);
        return step;
    }
    Outcome operator()(const PlacingTray& tray, const Voided&) const
    {
        if (answersTo(state, tray.index) == 0) return voidedBefore();
        Step step{state, {}};
        presentAgain(plan, step.next, tray.index);
        endPresentation(plan, step);
        return step;
    }
    Outcome operator()(const OnBreak&, const Voided&) const { return voidedBefore(); }

private:
    Step moved(const Stage& stage) const
    {
        Step step{state, {}};
        step.next.stage = stage;
        return step;
    }

    Step placing() const
    {
        Step step{state, {}};
        placeTray(plan, step);
        return step;
    }

    /// The presentation before this one turns out to have been invalid.
    Outcome voidedBefore() const
    {
        if (state.position == 0) return Refusal{"No presentation has been given yet."};
        const int before = state.order[static_cast<std::size_t>(state.position - 1)];
        if (answersTo(state, before) == 0) return Refusal{"The presentation before this one is void already."};
        Step step{state, {}};
        presentAgain(plan, step.next, before);
        const int next = step.next.order[static_cast<std::size_t>(step.next.position)];
        if (std::holds_alternative<OnBreak>(state.stage))
            step.next.stage = OnBreak{next};
        else
            placeTray(plan, step);
        return step;
    }
};

Outcome pause(const State& state)
{
    if (std::holds_alternative<Finished>(state.stage) || std::holds_alternative<Withdrawn>(state.stage))
        return Refusal{"The session is over; there is nothing to pause."};
    Step step{state, {ClearDisplay{}}};
    interrupt(step.next);
    step.next.paused = true;
    return step;
}

Outcome resume(const Plan& plan, const State& state)
{
    if (!state.paused) return Refusal{"The session is not paused."};
    Step step{state, {}};
    step.next.paused = false;
    if (std::holds_alternative<PlacingTray>(state.stage)) placeTray(plan, step);
    return step;
}

Outcome startSitting(const State& state)
{
    Step step{state, {ClearDisplay{}}};
    interrupt(step.next);
    ++step.next.sitting;
    return step;
}

Outcome withdraw(const State& state, const WithdrawnEvent& event)
{
    if (std::holds_alternative<Withdrawn>(state.stage)) return Refusal{"The participant has withdrawn already."};
    Step step{state, {ClearDisplay{}}};
    step.next.stage = Withdrawn{event.why};
    step.next.paused = false;
    return step;
}

Outcome correct(const Plan& plan, const State& state, const Corrected& event)
{
    if (std::holds_alternative<Withdrawn>(state.stage))
        return Refusal{"The participant has withdrawn; answers stay as they are."};
    const auto place = latestAnswerTo(plan, state, event.question);
    if (!place) return Refusal{"There is no answer to " + event.question.value + " yet."};
    Step step{state, {}};
    StoredAnswer& answer = step.next.answers[*place];
    if (const auto fault = faultOf(plan, answer.index, answer.question, event.response)) return Refusal{*fault};
    answer.response = event.response;
    return step;
}

/// The list's own order, until voids lengthen it.
State withOrder(const Plan& plan, State state)
{
    if (state.order.empty()) {
        state.order.resize(plan.trials.size());
        std::iota(state.order.begin(), state.order.end(), 0);
    }
    return state;
}

Outcome applyTo(const Plan& plan, const State& state, const Event& event)
{
    // The events that every stage takes, paused or not.
    if (std::holds_alternative<SittingStarted>(event.body)) return startSitting(state);
    if (std::holds_alternative<Resumed>(event.body)) return resume(plan, state);
    if (const auto* withdrawn = std::get_if<WithdrawnEvent>(&event.body)) return withdraw(state, *withdrawn);
    if (const auto* corrected = std::get_if<Corrected>(&event.body)) return correct(plan, state, *corrected);
    if (const auto* noted = std::get_if<Noted>(&event.body))
        return noted->text.empty() ? Outcome(Refusal{"The note is empty."}) : Outcome(Step{state, {}});
    if (state.paused) return Refusal{"The session is paused; resume it first."};
    if (std::holds_alternative<Paused>(event.body)) return pause(state);
    return std::visit(Transition{plan, state, event.atNs}, state.stage, event.body);
}

}  // namespace

std::variant<Step, Refusal> apply(const Plan& plan, const State& state, const Event& event)
{
    if (plan.trials.empty()) return Refusal{"The participant's list is empty."};
    return applyTo(plan, withOrder(plan, state), event);
}

}  // namespace study::session
