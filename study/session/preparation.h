// The way of a willing participant around the trials, for whoever plays a session without a person.
#pragma once

#include <optional>

#include "study/session/session.h"

namespace study::session {

/// Agrees, tells no facts, ticks every line of the checklist, ends breaks. Empty in the stages of a trial and
/// at the end.
std::optional<EventBody> nextOfPreparation(const protocols::Protocol& protocol, const Stage& stage);

}  // namespace study::session
