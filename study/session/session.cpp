// The transition table. Rows: stages; columns: events; an event in an empty cell is refused with a reason.
//
//                 | Begun | Con-   | Facts | Famil. | Famil. | Scale  | Scale  | Check- | Sitting
//                 |       | sented | Given | Shown  | Done   | Placed | T.Done | list   | Prepared
// ----------------+-------+--------+-------+--------+--------+--------+--------+--------+---------
// Enrolled        | prep. |        |       |        |        |        |        |        |
// Consenting      |       | prep.  |       |        |        |        |        |        |
// AskingFacts     |       |        | prep. |        |        |        |        |        |
// Familiarising   |       |        |       | shows  | prep.  |        |        |        |
// ScaleTraining   |       |        |       |        |        | +1     | prep.  |        |
// CheckingList    |       |        |       |        |        |        |        | Tray   |
// PlacingTray, OnBreak; in a sitting not prepared (paused or not) |       |        |        | Scale T.
//
//                 | Tray  | Touched | Answered  | Void | Break | Debriefed | Pause | Resume
//                 | Ready |         |           |      | Ended |           |       |
// ----------------+-------+---------+-----------+------+-------+-----------+-------+-------
// Enrolled ... CheckingList         |           |      |       |           | +p    |
// PlacingTray i   | Pres.b|         |           | (a)  |       |           | +p    |
// Presenting i q  |       | Pres.   | Pres. q+1 | next |       |           | Tray i|
//                 |       |         | or next   |      |       |           | +p    |
// OnBreak         |       |         |           | (a)  | Tray  |           | +p    |
// Debriefing      |       |         |           | (a)  |       | Finished  | +p    |
// Finished        |       |         |           |      |       |           |       |
// Withdrawn       |       |         |           |      |       |           |       |
// any, paused     |       |         |           |      |       |           |       | -p
//
// prep. = the next stage of the preparation that the protocol needs; PlacingTray after the last of them.
// next  = after the last question or a void: OnBreak at the end of a block or phase or when time is up, else PlacingTray of the
//         next presentation, or Debriefing after the last one.
// (a)   = voids the presentation that was just completed (or the interrupted one, if it has answers already) and stays in the
//         stage (from Debriefing: PlacingTray); the next tray may then be another one.
// b     = not within the dead time after the tray was asked for, so that a key that bounces arms no presentation.
// Not drawn, because every stage takes them:
// SittingStarted: Presenting i -> PlacingTray i; OnBreak at a sitting's end -> OnBreak between blocks or phases; a pause remains.
// Noted: the stage remains.
// WithdrawnEvent: -> Withdrawn, only once.
// Corrected: not after the end, and only if there is an answer to correct. An older version's log may hold one in Finished.
//
// True in every state: `order` holds each trial once and once more for each void, the trials of a phase together, blocks
// ascending. Presenting and PlacingTray concern trial order[position]. `answers` holds at most one answer to a question of a
// trial and none of a voided presentation.
#include "study/session/session_moves.h"

namespace study::session {

namespace {

using Outcome = std::variant<SessionStep, Refusal>;

/// The effect of one event in one stage. The general template is the empty cell of the table.
struct Transition {
    const Plan& plan;
    const State& state;
    std::int64_t atNs;

    template <class Stage, class Body>
    Outcome operator()(const Stage&, const Body& body) const
    {
        return Refusal{refusalOf(state, body)};
    }

    Outcome operator()(const Enrolled&, const Begun&) const { return preparedOn(); }
    Outcome operator()(const Consenting&, const Consented&) const { return preparedOn(); }
    Outcome operator()(const AskingFacts&, const FactsGiven&) const { return preparedOn(); }
    Outcome operator()(const Familiarising&, const FamiliarisationShown& shown) const
    {
        if (shown.item < 0 || shown.item >= static_cast<int>(plan.familiarisation.size()))
            return Refusal{"There is no such fabric for getting to know the display."};
        SessionStep step = moved(Familiarising{shown.item});
        step.effects.emplace_back(ShowStimulus{plan.familiarisation[static_cast<std::size_t>(shown.item)].sealedCode});
        return step;
    }
    Outcome operator()(const Familiarising&, const FamiliarisationDone&) const
    {
        SessionStep step{state, {ClearDisplay{}}};
        prepareOn(plan, step, atNs);
        return step;
    }
    Outcome operator()(const ScaleTraining& training, const ScalePlaced& placed) const
    {
        const auto place = placeToName(plan, state);
        if (!place) return Refusal{"The participant has named enough places."};
        if (placed.shown != *place) return Refusal{"This is not the place on the line that is shown."};
        const bool isRight = isRightPlace(*memorisedScaleOf(plan.protocol), placed.shown, placed.spoken);
        return moved(ScaleTraining{training.isRefresher, training.placed + 1, isRight ? training.rightInARow + 1 : 0,
                                   NamedPlace{placed.shown, placed.spoken, isRight}});
    }
    Outcome operator()(const ScaleTraining&, const ScaleTrainingDone&) const { return preparedOn(); }
    Outcome operator()(const CheckingList&, const ChecklistDone&) const { return preparedOn(); }
    Outcome operator()(const PlacingTray&, const SittingPrepared&) const { return refreshed(); }
    Outcome operator()(const OnBreak&, const SittingPrepared&) const { return refreshed(); }

    Outcome operator()(const OnBreak&, const BreakEnded&) const
    {
        SessionStep step{state, {}};
        step.next.restedAtNs = atNs;
        placeTray(plan, step, atNs);
        return step;
    }

    Outcome operator()(const PlacingTray& tray, const TrayReady& ready) const
    {
        if (state.deadTimeNs > 0 && atNs - state.trayAskedAtNs < state.deadTimeNs) return Refusal{tooSoon()};
        const protocols::SealedCode& code = plan.trials[static_cast<std::size_t>(tray.index)].sealedCode;
        if (code.empty()) return Refusal{"The server has not given out this presentation yet."};
        if (plan.protocol.confirmPieces)
            if (const auto fault = faultOfPieces(plan, tray.index, ready.pieces)) return Refusal{*fault};
        SessionStep step = moved(Presenting{tray.index, answersTo(state, tray.index), atNs, std::nullopt, TouchSource::Operator});
        step.next.trayTookNs = atNs - state.trayAskedAtNs;
        step.effects.emplace_back(ShowStimulus{code});
        if (const auto next = sealedCodeAt(plan, state, state.position + 1)) step.effects.emplace_back(Prefetch{*next});
        return step;
    }

    Outcome operator()(const Presenting& presenting, const Touched& touch) const
    {
        if (presenting.touchedAtNs) return Refusal{"The time of the first touch is stored already."};
        Presenting touched = presenting;
        // A display may report any age. A touch before the question was shown cannot belong to it.
        touched.touchedAtNs = stampOf(atNs, touch.agoNs, presenting.readyAtNs);
        touched.touchedBy = touch.by;
        return moved(touched);
    }

    Outcome operator()(const Presenting& presenting, const Answered& answered) const
    {
        if (const auto fault = faultOfAnswer(plan, presenting.index, presenting.question, answered.response))
            return Refusal{*fault};
        SessionStep step{state, {}};
        step.next.answers.push_back({presenting.index, presenting.question, answered.response});
        ++step.next.answersStored;
        if (presenting.question + 1 < questionsOf(plan, presenting.index))
            step.next.stage = Presenting{presenting.index, presenting.question + 1, atNs, std::nullopt, TouchSource::Operator};
        else
            endPresentation(plan, step, atNs);
        return step;
    }

    Outcome operator()(const Presenting& presenting, const Voided&) const
    {
        SessionStep step{state, {}};
        presentAgain(plan, step.next, presenting.index, state.position);
        endPresentation(plan, step, atNs);
        return step;
    }
    Outcome operator()(const PlacingTray& tray, const Voided&) const
    {
        if (answersTo(state, tray.index) == 0) return voidedBefore();
        SessionStep step{state, {}};
        presentAgain(plan, step.next, tray.index, state.position);
        endPresentation(plan, step, atNs);
        return step;
    }
    Outcome operator()(const OnBreak&, const Voided&) const { return voidedBefore(); }
    Outcome operator()(const Debriefing&, const Voided&) const { return voidedBefore(); }
    Outcome operator()(const Debriefing&, const Debriefed&) const { return moved(Finished{}); }

private:
    static std::string tooSoon()
    {
        return "The last step was only just taken, so this key confirmed nothing. Put the pieces on the tray, then confirm it.";
    }

    SessionStep moved(const Stage& stage) const
    {
        SessionStep step{state, {}};
        step.next.stage = stage;
        return step;
    }

    SessionStep preparedOn() const
    {
        SessionStep step{state, {}};
        prepareOn(plan, step, atNs);
        return step;
    }

    Outcome refreshed() const
    {
        if (state.preparedSitting == state.sitting) return Refusal{"This sitting is prepared already."};
        SessionStep step{state, {}};
        step.next.paused = false;
        step.next.restedAtNs = atNs;
        // The refresher comes after familiarisation; a study without ratings has none.
        step.next.stage = Familiarising{};
        prepareOn(plan, step, atNs);
        if (auto* training = std::get_if<ScaleTraining>(&step.next.stage)) training->isRefresher = true;
        return step;
    }

    /// Voids the presentation before the present one.
    Outcome voidedBefore() const
    {
        if (state.position == 0) return Refusal{"There has been no presentation yet."};
        const int before = state.order[static_cast<std::size_t>(state.position - 1)].index;
        if (answersTo(state, before) == 0) return Refusal{"The presentation before this one is void already."};
        SessionStep step{state, {}};
        presentAgain(plan, step.next, before, state.position - 1);
        const int next = step.next.order[static_cast<std::size_t>(step.next.position)].index;
        if (const auto* onBreak = std::get_if<OnBreak>(&state.stage))
            step.next.stage = OnBreak{next, onBreak->reason};
        else
            placeTray(plan, step, atNs);
        return step;
    }
};

Outcome pause(const State& state)
{
    if (std::holds_alternative<Finished>(state.stage) || std::holds_alternative<Withdrawn>(state.stage))
        return Refusal{"The session is over. There is nothing to pause."};
    SessionStep step{state, {ClearDisplay{}}};
    interrupt(step.next);
    step.next.paused = true;
    return step;
}

Outcome resume(const Plan& plan, const State& state, std::int64_t atNs)
{
    if (!state.paused) return Refusal{"The session is not paused."};
    SessionStep step{state, {}};
    step.next.paused = false;
    step.next.restedAtNs = atNs;
    if (std::holds_alternative<PlacingTray>(state.stage)) placeTray(plan, step, atNs);
    return step;
}

/// A new sitting is not over yet: a break that ended the sitting before becomes one between blocks or phases.
void renewBreak(const Plan& plan, State& state)
{
    auto* onBreak = std::get_if<OnBreak>(&state.stage);
    if (!onBreak || onBreak->reason != BreakReason::SittingOver) return;
    onBreak->reason = phaseBeginsAt(plan, state, state.position) ? BreakReason::Phase : BreakReason::Block;
}

/// The clock may start again at any value, so all times that are measured from stamps begin anew.
Outcome startSitting(const Plan& plan, const State& state, const SittingStarted& started, std::int64_t atNs)
{
    SessionStep step{state, {ClearDisplay{}}};
    interrupt(step.next);
    renewBreak(plan, step.next);
    ++step.next.sitting;
    step.next.sittingBeganAtNs = step.next.restedAtNs = step.next.trayAskedAtNs = step.next.breakBeganAtNs = atNs;
    step.next.preparedAtNs = atNs;
    step.next.sittingOverTold = false;
    step.next.deadTimeNs = started.deadTimeNs;
    return step;
}

Outcome withdraw(const State& state, const WithdrawnEvent& event)
{
    if (std::holds_alternative<Withdrawn>(state.stage)) return Refusal{"The participant has withdrawn already."};
    SessionStep step{state, {ClearDisplay{}}};
    step.next.stage = Withdrawn{event.why};
    step.next.paused = false;
    return step;
}

/// Blinded means are over finished participants. A correction after the end would move one and so name its trial.
Outcome correct(const Plan& plan, const State& state, const Corrected& event, EventSource source)
{
    if (source == EventSource::Present && std::holds_alternative<Finished>(state.stage))
        return Refusal{"The session is finished. Answers can be corrected until the debriefing is stored."};
    if (std::holds_alternative<Withdrawn>(state.stage))
        return Refusal{"The participant has withdrawn. Answers cannot be changed."};
    const auto place = latestAnswerTo(plan, state, event.question);
    if (!place) return Refusal{"There is no answer to " + event.question.value + " yet."};
    SessionStep step{state, {}};
    StoredAnswer& answer = step.next.answers[*place];
    if (const auto fault = faultOfAnswer(plan, answer.index, answer.question, event.response)) return Refusal{*fault};
    answer.response = event.response;
    return step;
}

Outcome note(const State& state, const Noted& event)
{
    if (event.text.empty() && !event.isFlag) return Refusal{"The note is empty."};
    if (event.isFlag && !presentationMeant(state)) return Refusal{"There is no presentation to flag yet."};
    return SessionStep{state, {}};
}

/// The state with the order of the participant's list, until a void adds to it.
State withOrder(const Plan& plan, State state)
{
    if (state.order.empty()) state.order = orderOf(plan);
    return state;
}

Outcome applyTo(const Plan& plan, const State& state, const Event& event)
{
    // Every stage takes these events, paused or not.
    if (const auto* started = std::get_if<SittingStarted>(&event.body)) return startSitting(plan, state, *started, event.atNs);
    if (std::holds_alternative<Resumed>(event.body)) return resume(plan, state, event.atNs);
    if (const auto* withdrawn = std::get_if<WithdrawnEvent>(&event.body)) return withdraw(state, *withdrawn);
    if (const auto* corrected = std::get_if<Corrected>(&event.body)) return correct(plan, state, *corrected, event.source);
    if (const auto* noted = std::get_if<Noted>(&event.body)) return note(state, *noted);
    if (state.paused && !std::holds_alternative<SittingPrepared>(event.body))
        return Refusal{"The session is paused. Resume it first."};
    if (std::holds_alternative<Paused>(event.body)) return pause(state);
    return std::visit(Transition{plan, state, event.atNs}, state.stage, event.body);
}

}  // namespace

std::variant<SessionStep, Refusal> apply(const Plan& plan, const State& state, const Event& event)
{
    if (plan.trials.empty()) return Refusal{"The participant's list is empty."};
    if (!isStamp(event.atNs)) return Refusal{"The time stamp of the event is outside every session."};
    return applyTo(plan, withOrder(plan, state), event);
}

bool isEnteredByOperator(const EventBody& event)
{
    return std::visit(protocols::Overloaded{[](const Touched& touch) { return touch.by == TouchSource::Operator; },
                                            [](const Consented& entry) { return entry.by == EnteredBy::Operator; },
                                            [](const FactsGiven& entry) { return entry.by == EnteredBy::Operator; },
                                            [](const ScalePlaced& entry) { return entry.by == EnteredBy::Operator; },
                                            [](const auto&) { return true; }},
                      event);
}

std::string nameOf(const State& state)
{
    const std::string stage =
        std::visit(protocols::Overloaded{
                       [](const Enrolled&) { return "Enrolled"; }, [](const Consenting&) { return "Consenting"; },
                       [](const AskingFacts&) { return "AskingFacts"; }, [](const Familiarising&) { return "Familiarising"; },
                       [](const ScaleTraining&) { return "ScaleTraining"; }, [](const CheckingList&) { return "CheckingList"; },
                       [](const PlacingTray&) { return "PlacingTray"; }, [](const Presenting&) { return "Presenting"; },
                       [](const OnBreak&) { return "OnBreak"; }, [](const Debriefing&) { return "Debriefing"; },
                       [](const Finished&) { return "Finished"; }, [](const Withdrawn&) { return "Withdrawn"; }},
                   state.stage);
    return state.paused ? stage + " (paused)" : stage;
}

}  // namespace study::session
