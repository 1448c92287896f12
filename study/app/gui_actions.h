// The movements of the hands that lead to each kind of event in the window.
#pragma once

#include "protocols/files/errors.h"
#include "study/app/gui_operator.h"

namespace study::app {

/// A movement that the page in front does not allow.
protocols::Error cannotPerform(const std::string& what);

/// Throws cannotPerform(...) where there is no way from the page in front to the event.
void performInWindow(GuiOperator& gui, MainWindow& window, const session::EventBody& event);

}  // namespace study::app
