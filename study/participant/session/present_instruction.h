// The participant's part of a session: what they see, from the view and the protocol's words, and which event their act is. What
// they see depends on no allocation, tray, code or question: the same moments of two sessions give the same instruction, whatever
// is presented.
#pragma once

#include "protocols/protocol.h"
#include "study/participant/participant_act.h"
#include "study/session/view.h"

namespace study::participant {

/// The instruction for this moment of the session. While presentations run it only says to wait or to feel the display.
Instruction instructionFor(const session::View& view, const protocols::Protocol& protocol);

/// The instruction while no session runs.
Instruction waiting(const protocols::Protocol& protocol);

/// The event of this act; empty where the participant does not agree, which the operator decides about, and where the session
/// does not ask for it (any more).
std::optional<session::EventBody> eventOf(const ParticipantAct& act, const session::View& view,
                                          const protocols::Protocol& protocol);

}  // namespace study::participant
