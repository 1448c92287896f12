#include "study/commands/recorded_act.h"

#include <cstdio>

#include "database/evidence/acts.h"
#include "study/commands/command_line.h"
#include "study/session/operated_by.h"

namespace study::commands {

void recordAct(const database::StudyStore& store, const std::string& kind, const std::filesystem::path& path)
{
    if (store.isUpgradedCopy()) {
        std::fprintf(stderr, "not recorded: an earlier version made this study, and only the app or `replay` upgrades it\n");
        return;
    }
    const auto by = session::operatedBy({}, versionText());
    const std::string whole = path.empty() ? "" : std::filesystem::absolute(path).lexically_normal().string();
    const auto refused =
        database::recordAct(store.folder(), {kind, by.operatorName, by.program, by.host, whole, store.head(), {}});
    if (refused) std::fprintf(stderr, "not recorded: %s\n", refused->c_str());
}

}  // namespace study::commands
