// What a protocol can balance and detect, for the app's editor.
#pragma once

#include "study/app/drafts/session_outlook.h"

namespace study::commands {

/// The numbers of `protocol show`. The orders of a large study are not drawn, because the window would wait for them.
app::SessionOutlook lookAhead(const protocols::Protocol& protocol);

}  // namespace study::commands
