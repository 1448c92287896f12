// Entry points of the window program, called by main. A QApplication must exist.
#pragma once

#include "study/app/state/app_options.h"

namespace study::app {

/// Settings of this user, kept between runs.
std::shared_ptr<QSettings> userSettings();

/// Shows the window until the operator closes it and returns QApplication's exit code. If the study cannot be opened,
/// the start page shows the reason. Another language that is chosen there replaces `language` and is kept in the settings.
int runApp(AppOptions options, LanguageInUse& language);

/// Shows the live monitor of `options.study` until it is closed. Throws protocols::Error if the folder is not a study.
int runMonitor(const AppOptions& options);

}  // namespace study::app
