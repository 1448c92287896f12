// The keys and clicks that make the window send each kind of event.
#pragma once

#include "protocols/files/errors.h"
#include "study/app/gui_operator.h"

namespace study::app {

/// Error for an action that the current page does not allow.
protocols::Error cannotPerform(const std::string& what);

/// Performs the keys and clicks for `event`. Throws cannotPerform(...) if the current page cannot send it.
void performInWindow(GuiOperator& gui, MainWindow& window, const session::EventBody& event);

}  // namespace study::app
