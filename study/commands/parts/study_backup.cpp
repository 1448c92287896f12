#include "study/commands/parts/study_backup.h"

#include <sys/stat.h>

#include <QProcess>

#include "database/keys.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/open_files.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;

/// Copies everything except the live database, its lock and the files that SQLite keeps beside it.
void copyFiles(const fs::path& study, const fs::path& to)
{
    for (const auto& entry : fs::directory_iterator(study)) {
        const std::string name = entry.path().filename().string();
        if (name != ".lock" && !name.starts_with("study.db")) fs::copy(entry.path(), to / name, fs::copy_options::recursive);
    }
    // The stimuli keep their equal time stamps: the order of copying must not reveal the order of making.
    if (fs::exists(study / "stimuli"))
        for (const auto& stimulus : fs::directory_iterator(study / "stimuli"))
            fs::last_write_time(to / "stimuli" / stimulus.path().filename(), fs::last_write_time(stimulus.path()));
}

/// Uses tar, which every Debian system has.
void pack(const fs::path& folder, const std::string& name, const fs::path& archive)
{
    const QStringList arguments{"--create",
                                "--file",
                                QString::fromStdString(archive.string()),
                                "--directory",
                                QString::fromStdString(folder.string()),
                                "--",
                                QString::fromStdString(name)};
    if (QProcess::execute(QStringLiteral("tar"), arguments) != 0)
        throw protocols::environmentFault({"tar could not pack the study", archive.string(), "room for a copy of the study",
                                           "make room or choose another disk; the study itself is untouched"});
}

/// "study" for "demo/study" and for "demo/study/".
std::string nameOfFolder(const fs::path& study)
{
    const fs::path whole = fs::absolute(study).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

std::vector<std::string> writeBackup(const database::StudyStore& store, const fs::path& out)
{
    const fs::path study = store.namedFolder();
    if (fs::exists(out))
        throw protocols::badInput(
            {"the file exists", out.string(), "the name of a new file", "choose another name; nothing was written"});
    const auto inStudy = fs::weakly_canonical(fs::absolute(out)).lexically_relative(fs::weakly_canonical(study));
    if (!inStudy.empty() && *inStudy.begin() != "..")
        throw protocols::badInput({"the backup would lie in the study and hold itself", out.string(),
                                   "a file outside " + study.string(), "choose another folder; nothing was written"});
    const std::string name = nameOfFolder(study);
    // Collect the files of the backup in a temporary folder beside it.
    const protocols::FolderDraft staging(out, protocols::Earlier::Refused);
    try {
        fs::permissions(staging.path(), fs::perms::owner_all);
        fs::create_directory(staging.path() / name);
        copyFiles(store.folder().folder, staging.path() / name);
        store.copyTo(staging.path() / name / "study.db");
        const fs::path archive = staging.path() / "archive.tar";
        pack(staging.path(), name, archive);
        ::chmod(archive.c_str(), 0600);  // it contains the allocation key
        protocols::putFileInPlace(archive, out);
    } catch (const fs::filesystem_error& fault) {
        if (protocols::isTooManyOpenFiles(fault.code().value())) throw protocols::tooManyOpenFiles(out.string());
        throw protocols::environmentFault({std::string("cannot write the backup: ") + fault.what(), out.string(),
                                           "room for a copy of the study",
                                           "make room or choose another disk; the study itself is untouched"});
    }
    return findingsOfKeys(store).faults;
}

}  // namespace study::commands
