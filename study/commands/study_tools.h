// The tools page of the window does the work of `study status|sheets|data-sheet`, `verify`, `backup`, `export` and `report`.
#pragma once

#include <string>

#include "study/app/state/study_tool.h"

namespace study::commands {

/// Nobody gives a passphrase here, so that a blinded study stays blinded. Backups, exports and reports are recorded as acts of
/// `operatorName`; empty for the name of the account.
app::UseTool studyTools(const std::string& operatorName);

}  // namespace study::commands
