// Plays a script through a session, from wherever the session is to its end.
#pragma once

#include <functional>

#include "database/study_store.h"
#include "protocols/allocation.h"
#include "study/players/hands.h"
#include "study/players/script.h"
#include "study/session/clock.h"

namespace study::players {

/// The trials of the participant's slot and what their file codes are.
struct ScriptedTrials {
    std::vector<protocols::BlindedTrial> trials;
    protocols::AllocationKey key;
    protocols::Protocol protocol;
};

/// `logged`: what the session's log already holds, so that events passed before a crash are not
/// repeated. `progress(answers stored)`. A missing or impossible answer throws badInput naming the
/// trial; what was answered before is stored.
void playScript(const Script& script, const ScriptedTrials& trials, const std::vector<database::EventRecord>& logged,
                Hands& hands, session::VirtualClock& clock, const std::function<void(int)>& progress = {});

}  // namespace study::players
