// What a protocol can balance and detect, for the app's editor.
#pragma once

#include "study/app/drafts/session_outlook.h"

namespace study::commands {

/// The numbers of `protocol show`. A study whose running orders would take long to draw has no balance, but a line that says so.
app::SessionOutlook lookAhead(const protocols::Protocol& protocol);

}  // namespace study::commands
