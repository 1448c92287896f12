// The parts of the transition table (session.cpp): questions about a state, and moves between presentations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "study/session/session.h"

namespace study::session {

const protocols::Phase& phaseOf(const Plan& plan, int index);
int questionsOf(const Plan& plan, int index);
const protocols::Question& questionOf(const Plan& plan, int index, int question);

/// The instruction of a trial's block; null where its phase gives none.
const protocols::BlockInstruction* instructionOf(const Plan& plan, int index);

/// The order of the participant's list with its blocks, before any void.
std::vector<PlaceInOrder> orderOf(const Plan& plan);

/// Number of current answers to the questions of a trial; also the number of its next question.
int answersTo(const State& state, int index);

/// Place of the answer in state.answers; empty if there is none.
std::optional<std::size_t> latestAnswerTo(const Plan& plan, const State& state, const protocols::QuestionId& question);

/// Sealed code of the presentation at this place of the order; empty after its end.
std::optional<protocols::SealedCode> sealedCodeAt(const Plan& plan, const State& state, int position);

/// Number of presentations of this trial up to this place of the order: 1, and one more for each void.
int attemptAt(const State& state, int position);

/// The same for a trial up to the present place: the attempt that its current answers belong to.
int attemptSoFar(const State& state, int index);

/// A presentation by its trial (place in the list) and its attempt (from 1).
struct PresentationMeant {
    int index = 0;
    int attempt = 1;
};

/// The presentation that a remark concerns now: the present one, or the last one, also where that was voided.
std::optional<PresentationMeant> presentationMeant(const State& state);

/// Whether order[position] asks the questions of another phase than order[position - 1]. The first presentation of all does not
/// count.
bool phaseBeginsAt(const Plan& plan, const State& state, int position);

/// Whether order[position - 1] ends a block or phase.
bool blockEndsBefore(const State& state, int position);

/// Places on the line that must be right in a row: three, or one in a refresher.
int placesInARow(const ScaleTraining& training);

/// The next place on the line for which the participant says a number; empty where enough were right in a row, and in other
/// stages. Places differ between participants and sittings. Every call returns the same one.
std::optional<protocols::Tenths> placeToName(const Plan& plan, const State& state);

/// Whether a clock of a session can give this time: 73 years or less from its zero, so that no difference of three such times
/// exceeds 64 bits.
bool isStamp(std::int64_t atNs);

/// The time so many nanoseconds before `atNs`, from `earliestNs` to `atNs`. It is `earliestNs` where the clock went back.
std::int64_t stampOf(std::int64_t atNs, std::int64_t agoNs, std::int64_t earliestNs);

/// Whether the number lies within a twentieth of the line from the place: on a scale with few steps, the same step.
bool isRightPlace(const protocols::RatingScale& scale, protocols::Tenths shown, protocols::Tenths named);

/// Why this answer cannot be stored for that question, as a sentence for the operator; empty if it can.
std::optional<std::string> faultOfAnswer(const Plan& plan, int index, int question, const GivenAnswer& answer);

/// Which piece that was read is not the one that its slot needs, as a sentence for the operator; empty if all are right.
std::optional<std::string> faultOfPieces(const Plan& plan, int index, const std::vector<std::string>& pieces);

/// Why a stage without a cell for this event refuses it.
std::string refusalOf(const State& state, const EventBody& body);

/// Presenting -> PlacingTray of the same trial, Familiarising -> no image shown; other stages stay.
void interrupt(State& state);

/// Enters the next stage of the preparation that the protocol needs, or PlacingTray after the last one.
void prepareOn(const Plan& plan, SessionStep& step, std::int64_t atNs);

/// Enters PlacingTray of order[position].
void placeTray(const Plan& plan, SessionStep& step, std::int64_t atNs);

/// Clears the display and enters the next presentation, a break, or the debriefing.
void endPresentation(const Plan& plan, SessionStep& step, std::int64_t atNs);

/// Number of pieces that the operator puts on the tray or moves for the presentation at this place of the order, if the tray of
/// the presentation before it still lies there.
int piecesToLay(const Plan& plan, const State& state, int position);

/// Removes the answers to a trial and presents it again: at the end of its block. If that block is over, at the end of the next
/// block of the same phase, or immediately if there is none.
void presentAgain(const Plan& plan, State& state, int index, int fromPosition);

}  // namespace study::session
