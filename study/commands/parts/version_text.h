// The version of the program as text.
#pragma once

#include <string>

namespace study::commands {

/// The text that `--version` prints and that studies store.
std::string versionText();

}  // namespace study::commands
