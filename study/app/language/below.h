// Sentences that come from rooms below the window: refusals of the session, faults of displays, flags, names of steps. These
// rooms write English, which the log, the command line and reports keep. A table of their sentences gives the window its own
// language.
#pragma once

#include <QString>
#include <string>
#include <vector>

namespace study::app {

/// The text in the language of the window. The line of an Error ("WHERE: WHAT; expected X; NEXT") is translated part by part.
/// What the table does not know stays English.
QString inOwnLanguage(const std::string& english);
QString inOwnLanguage(const char* english);
QString inOwnLanguage(const QString& english);

/// The sentences of the table; %1 to %4 stand for names, numbers and codes.
std::vector<QString> sentencesFromBelow();

}  // namespace study::app
