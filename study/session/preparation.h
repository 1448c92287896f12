// The events outside the trials of a participant who agrees to everything. Scripted and simulated participants send them.
#pragma once

#include <optional>

#include "study/session/session.h"

namespace study::session {

/// The next event: gives consent but no facts, ticks every line of the checklist, ends breaks. Empty in the stages of a trial and
/// at the end.
std::optional<EventBody> nextOfPreparation(const protocols::Protocol& protocol, const Stage& stage);

}  // namespace study::session
