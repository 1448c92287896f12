// The window program: one call for main. A QApplication must exist.
#pragma once

#include "study/app/app_options.h"

namespace study::app {

/// The settings kept for this user between runs.
std::shared_ptr<QSettings> userSettings();

/// Shows the window and returns QApplication's exit code when it is closed. A study that cannot be
/// opened is told on the start page.
int runApp(const AppOptions& options);

}  // namespace study::app
