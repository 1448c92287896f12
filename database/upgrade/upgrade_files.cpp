#include "database/upgrade/upgrade_files.h"

#include <system_error>

#include "database/schema.h"
#include "database/sqlite_connection.h"
#include "database/upgrade/prepared_upgrade.h"
#include "protocols/files/disk_sync.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

namespace fs = std::filesystem;

/// Runs steps on files. Throws environmentFault where one fails.
template <class Steps>
auto onFiles(const StudyFolder& folder, Steps steps)
{
    try {
        return steps();
    } catch (const fs::filesystem_error& fault) {
        throw protocols::environmentFault({std::string("the study cannot be upgraded (") + fault.what() + ")",
                                           folder.folder.string(), "a writable folder with room for a copy of the study",
                                           "make room and open the study again; no answer was lost"});
    }
}

/// Copies the database as one consistent file and every file beside it but the lock. A link would bring a file from elsewhere,
/// and so it is left out; the study keeps it, and `verify` names it.
void copyTopFiles(const StudyFolder& folder, const fs::path& to)
{
    SqliteConnection(folder.database(), SqliteConnection::Mode::Read)
        .run(QStringLiteral("VACUUM INTO ?"), {toQt((to / "study.db").string())});
    for (const auto& entry : fs::directory_iterator(folder.folder)) {
        const std::string name = entry.path().filename().string();
        if (entry.symlink_status().type() != fs::file_type::regular || name == ".lock" || name.starts_with("study.db")) continue;
        protocols::copyBytes(entry.path(), to / name);
    }
    for (const auto& entry : fs::directory_iterator(to)) keepToOwner(entry.path());
}

/// A sentence that names what the copy before an upgrade lacks for that reason; empty where it lacks nothing.
std::string namesOfLinks(const StudyFolder& folder)
{
    std::string names;
    for (const auto& entry : fs::directory_iterator(folder.folder))
        if (entry.is_symlink() && entry.path().filename() != "stimuli")
            names += (names.empty() ? "" : ", ") + protocols::printable(entry.path().filename().string());
    return names.empty() ? "" : " It lacks the links of the study: " + names + ".";
}

/// The stimuli need no room of their own: the copy has other names of the same files.
void linkStimuli(const fs::path& stimuli, const fs::path& to)
{
    if (!fs::is_directory(stimuli)) return;
    fs::create_directory(to);
    keepToOwner(to);
    for (const auto& entry : fs::directory_iterator(stimuli)) {
        const fs::path target = to / entry.path().filename();
        std::error_code notLinked;
        fs::create_hard_link(entry.path(), target, notLinked);
        if (!notLinked) continue;
        if (entry.symlink_status().type() == fs::file_type::regular)
            protocols::copyBytes(entry.path(), target);
        else
            fs::copy(entry.path(), target, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
    }
}

fs::path firstFreeName(const fs::path& wanted)
{
    fs::path name = wanted;
    for (int number = 2; fs::exists(name); ++number) name = wanted.string() + "-" + std::to_string(number);
    return name;
}

fs::path backUp(const StudyFolder& folder)
{
    const fs::path place = firstFreeName(folder.beforeUpgrade());
    protocols::FolderDraft draft(place, protocols::Earlier::Refused);
    keepToOwner(draft.path());
    copyTopFiles(folder, draft.path());
    linkStimuli(folder.stimuli(), draft.path() / "stimuli");
    draft.putInPlace();
    return place;
}

/// SQLite would take the log of the older file for one of the new file, so that the older one must end first.
void replaceDatabase(const StudyFolder& folder)
{
    {
        const SqliteConnection older(folder.database(), SqliteConnection::Mode::Write);
        if (fromQt(older.value(QStringLiteral("PRAGMA journal_mode = DELETE"))) != "delete")
            throw protocols::environmentFault({"another program reads the study", folder.folder.string(), "no other program",
                                               "close it and open the study again"});
    }
    protocols::putFileInPlace(folder.upgrade() / "study.db", folder.database());
}

/// Step 4 may find any part of itself done.
void finish(const StudyFolder& folder, const UpgradeStep& reached)
{
    if (const fs::path made = folder.upgrade() / "stimuli"; fs::exists(made)) {
        fs::remove_all(folder.stimuli());
        reached("open stimuli removed");
        fs::rename(made, folder.stimuli());
        reached("sealed stimuli in place");
    }
    for (const fs::path& key : {folder.allocationKey(), folder.stationKey()})
        if (const fs::path made = folder.upgrade() / key.filename(); fs::exists(made)) {
            fs::rename(made, key);
            reached(key.filename().string() + " in place");
        }
    fs::remove(folder.maskedKey());
    keepToOwner(folder.folder);
    if (fs::exists(folder.protocol())) keepToOwner(folder.protocol());
    protocols::syncFolder(folder.folder);
    reached("masked key removed");
    fs::remove_all(folder.upgrade());
    protocols::syncFolder(folder.folder);
}

/// Whether a copy of an older study names the participant. One that cannot be read counts, because nobody knows what it holds.
bool isAbout(const fs::path& database, const std::string& participant)
{
    try {
        const SqliteConnection older(database, SqliteConnection::Mode::Read);
        checkedVersion(older);
        return older.value(QStringLiteral("SELECT COUNT(*) FROM participants WHERE id = ?"), {toQt(participant)}).toInt() > 0;
    } catch (const protocols::Error&) {
        return true;
    }
}

/// The copy before an upgrade is not sealed, so a failed upgrade leaves none: the older study still lies in its place.
void replaceOrRemove(const StudyFolder& folder, const fs::path& copy)
{
    try {
        replaceDatabase(folder);
    } catch (...) {
        if (isOlder(folder)) fs::remove_all(copy);
        throw;
    }
}

}  // namespace

void keepToOwner(const fs::path& place)
{
    std::error_code refused;
    const bool isFolder = fs::is_directory(place, refused);
    fs::permissions(place, isFolder ? fs::perms::owner_all : fs::perms::owner_read | fs::perms::owner_write, refused);
}

bool isOlder(const StudyFolder& folder)
{
    return checkedVersion({folder.database(), SqliteConnection::Mode::Read}) < schemaVersion;
}

bool hasUnfinishedUpgrade(const StudyFolder& folder) { return fs::exists(folder.upgrade()); }

std::string upgrade(const StudyFolder& folder, const UpgradeStep& step)
{
    const UpgradeStep reached = step ? step : [](const std::string&) {};
    return onFiles(folder, [&]() -> std::string {
        if (!isOlder(folder)) {
            finish(folder, reached);
            return folder.folder.string() + ": an upgrade that was interrupted is finished";
        }
        prepareAnew(folder);
        reached("prepared");
        const fs::path copy = backUp(folder);
        reached("copied");
        replaceOrRemove(folder, copy);
        reached("database in place");
        finish(folder, reached);
        return folder.folder.string() +
               ": an earlier version of this program made this study. It is upgraded. The study as it was "
               "lies in " +
               copy.string() +
               ". That copy is not sealed: it names the condition of every trial, and answers erased "
               "before can be guessed from it. Delete it when the upgraded study works." +
               namesOfLinks(folder);
    });
}

std::unique_ptr<protocols::TemporaryFolder> upgradedCopy(const StudyFolder& folder)
{
    auto copy = std::make_unique<protocols::TemporaryFolder>();
    const StudyFolder copied{copy->path()};
    return onFiles(copied, [&] {
        copyTopFiles(folder, copied.folder);
        constexpr auto withLinksAsTheyAre = fs::copy_options::recursive | fs::copy_options::copy_symlinks;
        if (fs::exists(folder.upgrade())) fs::copy(folder.upgrade(), copied.upgrade(), withLinksAsTheyAre);
        if (fs::is_directory(folder.stimuli())) linkStimuli(folder.stimuli(), copied.stimuli());
        for (const char* name : {"erasures", "prompts"})
            if (fs::is_directory(folder.folder / name)) fs::copy(folder.folder / name, copied.folder / name, withLinksAsTheyAre);
        if (isOlder(copied)) {
            prepareAnew(copied);
            replaceDatabase(copied);
        }
        finish(copied, [](const std::string&) {});
        return std::move(copy);
    });
}

std::vector<std::string> copiesBeforeUpgradeOf(const std::string& participant, const StudyFolder& folder)
{
    std::vector<std::string> copies;
    const std::string first = folder.beforeUpgrade().filename().string();
    for (const auto& entry : fs::directory_iterator(folder.folder)) {
        const fs::path copy = entry.path() / "study.db";
        if (!entry.path().filename().string().starts_with(first) || !fs::exists(copy)) continue;
        if (isAbout(copy, participant)) copies.push_back((entry.path().filename() / "study.db").string());
    }
    return copies;
}

}  // namespace database
