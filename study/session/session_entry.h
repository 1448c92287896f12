// What the study keeps of an accepted event: its answers, the trial that it voids, its note, the facts, the new state of the
// slot. The driver stores it; a simulation in memory counts it. Both take it from here.
#pragma once

#include <cstdint>

#include "database/session_store.h"
#include "protocols/new_texts.h"
#include "study/session/session.h"

namespace study::session {

/// The fact that holds the debriefing.
inline constexpr const char* debriefingFact = protocols::debriefingFact;

/// `next`: the state after the event, as apply() returned it. The event's own row, its stamp of storing and the finger are empty.
database::SessionStore::Append entryOf(const Plan& plan, const State& before, const State& next, const EventBody& body,
                                       std::int64_t atNs);

}  // namespace study::session
