#include "study/commands/recorded_act.h"

#include <cstdio>

#include "database/server/study_move.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/temporary_folder.h"
#include "study/commands/command_line.h"
#include "study/session/operated_by.h"

namespace study::commands {

namespace {

/// A folder that stood there with files keeps its mode.
void noteIfOpen(const std::filesystem::path& path)
{
    using std::filesystem::perms;
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    if (!std::filesystem::is_directory(status) || !protocols::keepsAccessRights(path) ||
        (status.permissions() & (perms::group_all | perms::others_all)) == perms::none)
        return;
    std::fprintf(stderr, "note: others on this computer can open the folder %s; `chmod 700` closes it\n",
                 protocols::printable(path.string()).c_str());
}

}  // namespace

std::string addAct(const database::StudyStore& store, const std::string& kind, const std::filesystem::path& path,
                   const std::string& operatorName, const std::string& note, const std::optional<database::LogHead>& head)
{
    if (store.isUpgradedCopy()) return "an earlier version made this study, and only the app or `replay` upgrades it";
    const auto by = session::operatedBy(operatorName, versionText());
    const std::string whole = path.empty() ? "" : std::filesystem::absolute(path).lexically_normal().string();
    const database::Act act{kind, by.operatorName, by.program, by.host, whole, head.value_or(store.head()), {}, note};
    return (store.serverFolder().empty() ? database::recordAct(store.folder(), act)
                                         : database::recordActOnServer({store.serverFolder()}, act))
        .value_or("");
}

void recordAct(const database::StudyStore& store, const std::string& kind, const std::filesystem::path& path,
               const std::string& note, const std::optional<database::LogHead>& head)
{
    if (const std::string refused = addAct(store, kind, path, {}, note, head); !refused.empty())
        std::fprintf(stderr, "not recorded: %s\n", protocols::printable(refused).c_str());
    noteIfOpen(path);
}

StateForFiles::StateForFiles(const database::StudyStore& store)
    : m_store(store), m_state(store.readOneState()), m_head(store.head())
{
}

const database::LogHead& StateForFiles::end()
{
    m_state.reset();
    return m_head;
}

void StateForFiles::record(const std::string& kind, const std::filesystem::path& path, const std::string& note)
{
    recordAct(m_store, kind, path, note, end());
}

void noteIfReadByAll(const std::filesystem::path& secret)
{
    std::error_code unknown;
    const auto whole = std::filesystem::absolute(secret, unknown).lexically_normal();
    const bool isFolder = std::filesystem::is_directory(whole, unknown);
    if (protocols::keepsAccessRights(isFolder ? whole : whole.parent_path())) return;
    std::fprintf(stderr,
                 "note: the file system of %s keeps no access rights: every account that sees it can read it; move it to a disk "
                 "that keeps them\n",
                 protocols::printable(secret.string()).c_str());
}

}  // namespace study::commands
