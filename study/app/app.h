// The window program: one call for main. A QApplication must exist.
#pragma once

#include "study/app/state/app_options.h"

namespace study::app {

/// The settings kept for this user between runs.
std::shared_ptr<QSettings> userSettings();

/// Shows the window and returns QApplication's exit code when it is closed. A study that cannot be
/// opened is told on the start page.
int runApp(const AppOptions& options);

/// Shows the live monitor of `options.study` until it is closed. Throws protocols::Error where that is no study.
int runMonitor(const AppOptions& options);

}  // namespace study::app
