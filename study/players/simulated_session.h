// Plays whole sessions of simulated participants, whatever their model of judgement is: the preparation, every trial, and what
// goes wrong on the way. Each step is an event that the session may refuse, as a person's is.
#pragma once

#include <functional>

#include "protocols/orders/allocation.h"
#include "protocols/protocol.h"
#include "study/players/hands.h"
#include "study/players/mishaps.h"
#include "study/players/simulated_participant.h"
#include "study/session/clock.h"

namespace study::players {

/// How a simulated participant answers one question about a presentation.
using Judge = std::function<SimulatedParticipant::Judgement(const protocols::BlindedTrial&, const protocols::Question&)>;

/// The judge that asks this participant, who must outlive it.
Judge judgeOf(SimulatedParticipant& participant);

/// Plays the session from its present state to its end. Throws workFailed where the session refuses a step that it should take.
/// `progress` gets the number of stored answers.
void playSession(const Judge& judge, Mishaps& mishaps, const session::Plan& plan, Hands& hands, session::VirtualClock& clock,
                 const std::function<void(int)>& progress = {});

}  // namespace study::players
