#include "study/commands/parts/study_backup.h"

#include <sys/stat.h>

#include <QProcess>
#include <QProcessEnvironment>
#include <algorithm>

#include "database/keys.h"
#include "database/sqlite_connection.h"
#include "database/study_rows.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/open_files.h"
#include "protocols/files/whole_file.h"
#include "protocols/secrets/secret_variables.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;

bool isLiveFile(const std::string& name)
{
    return name == ".lock" || name == "study.db" || name == "study.db-wal" || name == "study.db-shm" ||
           name == "study.db-journal";
}

/// Some network shares keep neither modes nor times. Then the copy keeps those that it got.
void copyRegular(const fs::directory_entry& file, const fs::path& to)
{
    protocols::copyBytes(file.path(), to);
    std::error_code notKept;
    fs::permissions(to, file.status().permissions(), notKept);
}

/// Copies files and folders into a new folder. A link would bring a file from elsewhere, and a pipe has no end: they are left
/// out.
void copyFolder(const fs::path& from, const fs::path& to, const fs::path& study, std::vector<std::string>& leftOut)
{
    fs::create_directory(to);
    for (const auto& entry : fs::directory_iterator(from)) {
        const fs::path place = to / entry.path().filename();
        if (from == study && isLiveFile(entry.path().filename().string())) continue;
        if (entry.symlink_status().type() == fs::file_type::directory)
            copyFolder(entry.path(), place, study, leftOut);
        else if (entry.symlink_status().type() == fs::file_type::regular)
            copyRegular(entry, place);
        else
            leftOut.push_back(entry.path().lexically_relative(study).string() +
                              ": not in the backup, because it is no file and no folder");
    }
}

/// Copies everything except the live database, its lock and the files that SQLite keeps beside it. Returns what was left out.
std::vector<std::string> copyFiles(const fs::path& study, const fs::path& to)
{
    std::vector<std::string> leftOut;
    copyFolder(study, to, study, leftOut);
    // The stimuli keep their equal time stamps: the order of copying must not reveal the order of making.
    std::error_code notKept;
    if (fs::is_directory(to / "stimuli"))
        for (const auto& stimulus : fs::directory_iterator(to / "stimuli"))
            fs::last_write_time(stimulus.path(), fs::last_write_time(study / "stimuli" / stimulus.path().filename()), notKept);
    return leftOut;
}

/// Uses tar, which every Debian system has. Its options of the surroundings could leave files out.
void pack(const fs::path& folder, const std::string& name, const fs::path& archive)
{
    const QStringList arguments{"--create",
                                "--file",
                                QString::fromStdString(archive.string()),
                                "--directory",
                                QString::fromStdString(folder.string()),
                                "--",
                                QString::fromStdString(name)};
    QProcess tar;
    QProcessEnvironment surroundings = protocols::withoutSecrets(QProcessEnvironment::systemEnvironment());
    surroundings.remove(QStringLiteral("TAR_OPTIONS"));
    tar.setProcessEnvironment(surroundings);
    tar.setProcessChannelMode(QProcess::ForwardedChannels);
    tar.start(QStringLiteral("tar"), arguments);
    if (!tar.waitForFinished(-1) || tar.exitStatus() != QProcess::NormalExit || tar.exitCode() != 0)
        throw protocols::environmentFault({"tar could not pack the study", archive.string(), "room for a copy of the study",
                                           "make room or choose another disk; the study itself is untouched"});
}

/// "study" for "demo/study" and for "demo/study/".
std::string nameOfFolder(const fs::path& study)
{
    const fs::path whole = fs::absolute(study).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

/// The names of the databases in the folder that a rescue wrote or put aside.
std::vector<std::string> keptDatabases(const fs::path& study)
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(study))
        if (entry.path().extension() == ".db" && entry.path().filename() != "study.db")
            names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

/// Entries of the log that belong to no participant. Such acts change files beside the database, too.
qulonglong actsOnStudy(const database::SqliteConnection& database)
{
    return database.value(QStringLiteral("SELECT COUNT(*) FROM events WHERE participant = ''")).toULongLong();
}

}  // namespace

Backup writeBackup(const database::StudyStore& store, const fs::path& out)
{
    const fs::path study = store.namedFolder();
    protocols::requireNewFile(out);
    const auto inStudy = fs::weakly_canonical(fs::absolute(out)).lexically_relative(fs::weakly_canonical(study));
    if (!inStudy.empty() && *inStudy.begin() != "..")
        throw protocols::badInput({"the backup would lie in the study and hold itself", out.string(),
                                   "a file outside " + study.string(), "choose another folder; nothing was written"});
    const std::string name = nameOfFolder(study);
    Backup backup;
    std::vector<std::string>& faults = backup.faults;
    // An erasure waits: the copy would hold what it removes.
    const database::SqliteConnection reader(store.folder().database(), database::SqliteConnection::Mode::Read);
    const database::ReadSnapshot held(reader);
    const qulonglong actsBefore = actsOnStudy(reader);
    // Collect the files of the backup in a temporary folder beside it.
    const protocols::FolderDraft staging(out, protocols::Earlier::Refused);
    try {
        faults = copyFiles(store.folder().folder, staging.path() / name);
        store.copyTo(staging.path() / name / "study.db");
        {
            const database::SqliteConnection copy(staging.path() / name / "study.db", database::SqliteConnection::Mode::Kept);
            backup.head = database::headIn(copy);
            backup.answers = copy.value(QStringLiteral("SELECT COUNT(*) FROM responses WHERE is_correction = 0")).toULongLong();
            if (actsOnStudy(copy) != actsBefore)
                throw protocols::workFailed({"the study was changed while it was copied", study.string(),
                                             "no registration, amendment or unblinding meanwhile",
                                             "run the command again; no backup was written"});
        }
        // A session that was killed leaves its log beside study.db. Unpacked over that folder, this one takes its place: SQLite
        // would add the old log to the restored database.
        protocols::writeWholeFile(staging.path() / name / "study.db-wal", "", protocols::Sync::Later,
                                  protocols::Readers::OwnerOnly);
        const fs::path archive = staging.path() / "archive.tar";
        pack(staging.path(), name, archive);
        ::chmod(archive.c_str(), 0600);  // it contains the allocation key
        protocols::putNewFileInPlace(archive, out);
    } catch (const fs::filesystem_error& fault) {
        if (protocols::isTooManyOpenFiles(fault.code().value())) throw protocols::tooManyOpenFiles(out.string());
        throw protocols::environmentFault(
            {std::string("cannot write the backup: ") + fault.what(), out.string(),
             "files that this account may read, and room for a copy of the study",
             "check the permissions, make room or choose another disk; the study itself is untouched"});
    }
    for (const std::string& fault : findingsOfKeys(store).faults) faults.push_back(fault);
    if (!store.erasures().empty())
        for (const std::string& file : keptDatabases(study))
            faults.push_back(file + ": packed, too; it may hold what was erased from the study since it was kept aside");
    return backup;
}

}  // namespace study::commands
