// Lets another program compute the numbers of a report again, by the script that lies in the report.
#pragma once

#include <filesystem>
#include <string>

namespace study::commands {

/// Runs the script of `language` ("R" or "python") in the folder of a report and prints what it says: which numbers differ, and
/// "reproduced: n of n". Where the language is not installed, one line says so. Throws workFailed where a number differs or the
/// script ends early, badInput where the report has no scripts because the study is blinded.
void checkReport(const std::filesystem::path& report, const std::string& language);

}  // namespace study::commands
