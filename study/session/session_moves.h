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

/// Current answers to the questions of a trial; also the number of its next unanswered question.
int answersTo(const State& state, int index);

/// Into state.answers.
std::optional<std::size_t> latestAnswerTo(const Plan& plan, const State& state, const protocols::QuestionId& question);

/// Of the presentation at a place of the order; none behind its end.
std::optional<protocols::FileCode> fileCodeAt(const Plan& plan, const State& state, int position);

/// Presentations of its phase that lie before `position` in the order.
int donePresentationsOfPhase(const Plan& plan, const State& state, int position);

/// Whether a break is due between order[position - 1] and order[position].
bool breakIsDueBefore(const Plan& plan, const State& state, int position);

/// Why this response cannot be stored as the answer to that question; a sentence for the operator.
std::optional<std::string> faultOf(const Plan& plan, int index, int question, const Response& response);

/// Why an event is refused in a stage that has no place for it.
std::string refusalOf(const State& state, const EventBody& body);

/// Presenting -> PlacingTray of the same trial; anything else stays.
void interrupt(State& state);

/// Enters PlacingTray of order[position].
void placeTray(const Plan& plan, Step& step);

/// Clears the display and goes to the next presentation, a break, or the end.
void endPresentation(const Plan& plan, Step& step);

/// Forgets the answers to a trial and appends it to the end of its phase.
void presentAgain(const Plan& plan, State& state, int index);

}  // namespace study::session
