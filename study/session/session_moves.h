// The steps that the transition table (session.cpp) is made of: questions about a state, and the
// moves between presentations.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "study/session/session.h"

namespace study::session {

const protocols::Phase& phaseOf(const Plan& plan, int index);
int questionsOf(const Plan& plan, int index);
const protocols::Question& questionOf(const Plan& plan, int index, int question);

/// The list's own order with its blocks, before any void.
std::vector<PlaceInOrder> orderOf(const Plan& plan);

/// Current answers to the questions of a trial; also the number of its next unanswered question.
int answersTo(const State& state, int index);

/// Into state.answers.
std::optional<std::size_t> latestAnswerTo(const Plan& plan, const State& state, const protocols::QuestionId& question);

/// Of the presentation at a place of the order; none behind its end.
std::optional<protocols::FileCode> fileCodeAt(const Plan& plan, const State& state, int position);

/// How often the trial at this place was presented up to there: 1, and one more for each void.
int attemptAt(const State& state, int position);

/// Whether order[position - 1] ends a block or phase.
bool blockEndsBefore(const State& state, int position);

/// Places on the line, off its marks, that the participant puts a number to: three, in a refresher one.
/// They differ between participants and sittings and are the same whenever they are asked for.
std::vector<protocols::Tenths> placesToName(const Plan& plan, const State& state);

/// Why this answer cannot be stored as the answer to that question; a sentence for the operator.
std::optional<std::string> faultOfAnswer(const Plan& plan, int index, int question, const GivenAnswer& answer);

/// Why an event is refused in a stage that has no place for it.
std::string refusalOf(const State& state, const EventBody& body);

/// Presenting -> PlacingTray of the same trial; anything else stays, but the display is cleared.
void interrupt(State& state);

/// The next stage of the preparation after `state.stage`, of those for which the protocol has something.
void prepareOn(const Plan& plan, SessionStep& step, std::int64_t atNs);

/// Enters PlacingTray of order[position].
void placeTray(const Plan& plan, SessionStep& step, std::int64_t atNs);

/// Clears the display and goes to the next presentation, a break, or the debriefing.
void endPresentation(const Plan& plan, SessionStep& step, std::int64_t atNs);

/// Forgets the answers to a trial and presents it again: at the end of its block or, where that is over,
/// of the block that follows in the same phase, or else at once.
void presentAgain(const Plan& plan, State& state, int index, int fromPosition);

}  // namespace study::session
