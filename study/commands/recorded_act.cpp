#include "study/commands/recorded_act.h"

#include <cstdio>

#include "database/server/study_move.h"
#include "study/commands/command_line.h"
#include "study/session/operated_by.h"

namespace study::commands {

std::string addAct(const database::StudyStore& store, const std::string& kind, const std::filesystem::path& path,
                   const std::string& operatorName)
{
    if (store.isUpgradedCopy()) return "an earlier version made this study, and only the app or `replay` upgrades it";
    const auto by = session::operatedBy(operatorName, versionText());
    const std::string whole = path.empty() ? "" : std::filesystem::absolute(path).lexically_normal().string();
    const database::Act act{kind, by.operatorName, by.program, by.host, whole, store.head(), {}};
    return (store.serverFolder().empty() ? database::recordAct(store.folder(), act)
                                         : database::recordActOnServer({store.serverFolder()}, act))
        .value_or("");
}

void recordAct(const database::StudyStore& store, const std::string& kind, const std::filesystem::path& path)
{
    if (const std::string refused = addAct(store, kind, path); !refused.empty())
        std::fprintf(stderr, "not recorded: %s\n", refused.c_str());
}

}  // namespace study::commands
