// Plays a script through a session, from the session's present state to its end.
#pragma once

#include <functional>

#include "database/study_store.h"
#include "protocols/orders/allocation.h"
#include "study/players/hands.h"
#include "study/players/script.h"
#include "study/session/clock.h"

namespace study::players {

/// The trials of the participant's slot and the meaning of their file codes.
struct ScriptedTrials {
    std::vector<protocols::BlindedTrial> trials;
    protocols::AllocationKey key;
    protocols::Protocol protocol;
    session::PieceNames fabricNames = {};
};

/// `logged`: the events in the session's log, so that events before a crash are not repeated. `progress` gets the number of
/// stored answers. Throws badInput for a missing or impossible answer, naming the trial; earlier answers remain stored.
void playScript(const Script& script, const ScriptedTrials& trials, const std::vector<database::EventRecord>& logged,
                Hands& hands, session::VirtualClock& clock, const std::function<void(int)>& progress = {});

}  // namespace study::players
