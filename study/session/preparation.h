// The events outside the trials of a participant who agrees to everything. Scripted and simulated participants send them.
#pragma once

#include <optional>

#include "study/session/session.h"

namespace study::session {

/// The next event: gives consent but no facts, ticks every line of the checklist, ends breaks. Empty in the stages of a trial and
/// at the end.
std::optional<EventBody> nextOfPreparation(const protocols::Protocol& protocol, const Stage& stage);

/// The tray as it should be: every piece is confirmed where the protocol asks for it.
TrayReady trayReadyOf(const protocols::Protocol& protocol, const std::vector<protocols::FabricId>& tray, const PieceNames& names);

}  // namespace study::session
