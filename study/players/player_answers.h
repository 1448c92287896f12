// How scripted and simulated participants answer each kind of question.
#pragma once

#include <string>

#include "protocols/orders/allocation.h"
#include "protocols/protocol.h"
#include "study/players/script.h"
#include "study/players/simulated_participant.h"
#include "study/session/given_answer.h"

namespace study::players {

/// The presentation of a scripted answer.
struct ScriptedPresentation {
    const std::vector<protocols::FabricId>& tray;  ///< in slot order
    const protocols::FabricId& truth;              ///< the fabric of the rendering
    std::string name;                              ///< the script and the trial, for errors
};

/// A fabric id, "correct" or "foil:1" for a choice, in this order; "same", "different", "correct" or "wrong" for same/different;
/// words for free text; a number for a rating. The session refuses a number for another kind of question. Throws badInput for a
/// text that answers no question of this kind on this tray.
session::GivenAnswer scriptedAnswer(const ScriptedResponse& scripted, const protocols::AnswerKind& kind,
                                    const ScriptedPresentation& presentation);

/// The answer in the form of a script: a rating as a number in scale units, any other answer as text.
ScriptedResponse scriptedFormOf(const session::GivenAnswer& answer);

/// The answer of the simulated participant; empty words if the question asks for free text. Choices follow the instruction of the
/// trial's block; ratings take their usual time.
SimulatedParticipant::Judgement simulatedAnswer(SimulatedParticipant& participant, const protocols::BlindedTrial& trial,
                                                const protocols::Question& question);

}  // namespace study::players
