#include "study/commands/command_line.h"

namespace study::commands {

std::string versionText() { return "vis2hap " VIS2HAP_VERSION; }

std::string commitText() { return VIS2HAP_COMMIT; }

}  // namespace study::commands
