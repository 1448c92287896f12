// vis2hap erase STUDY --participant ID, and vis2hap backup STUDY --out FILE
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <QProcess>
#include <cstdio>
#include <memory>

#include "database/study_store.h"
#include "protocols/files/errors.h"
#include "study/commands/command_line.h"
#include "study/records/stored_study.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;

int erase(const std::string& study, const database::Erasure& erasure)
{
    database::StudyStore store({study}, database::StudyStore::Access::Write);
    store.erase(erasure);
    std::printf("%s: %s of %s erased, recorded\n", study.c_str(),
                erasure.answersToo ? "facts, debriefing, answers and notes" : "facts and debriefing",
                erasure.participant.value.c_str());
    return 0;
}

/// A folder beside the backup in which its files lie together; vanishes at the end.
class Staging {
public:
    explicit Staging(const fs::path& out) : m_folder(out)
    {
        m_folder += ".partial-" + std::to_string(getpid());
        std::error_code failure;
        fs::create_directories(m_folder, failure);
        if (failure || ::chmod(m_folder.c_str(), 0700) != 0)
            throw protocols::environmentFault({"cannot make a folder beside the backup (" + failure.message() + ")",
                                               m_folder.string(), "a writable place", "choose another one"});
    }
    ~Staging()
    {
        std::error_code ignored;
        fs::remove_all(m_folder, ignored);
    }
    const fs::path& folder() const { return m_folder; }

private:
    fs::path m_folder;
};

/// Everything but the live database, its lock and what SQLite keeps beside it.
void copyFiles(const fs::path& study, const fs::path& to)
{
    for (const auto& entry : fs::directory_iterator(study)) {
        const std::string name = entry.path().filename().string();
        if (name != ".lock" && !name.starts_with("study.db")) fs::copy(entry.path(), to / name, fs::copy_options::recursive);
    }
    // Equal time stamps, as the study's own stimuli have: a copy must not tell the order of making.
    if (fs::exists(study / "stimuli"))
        for (const auto& stimulus : fs::directory_iterator(study / "stimuli"))
            fs::last_write_time(to / "stimuli" / stimulus.path().filename(), fs::last_write_time(stimulus.path()));
}

/// tar is on every Debian system.
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

/// "study" of "demo/study" and of "demo/study/".
std::string nameOfFolder(const fs::path& study)
{
    const fs::path whole = fs::absolute(study).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

int backup(const std::string& study, const std::string& out)
{
    if (fs::exists(out))
        throw protocols::badInput({"the file exists", out, "a new file", "choose another name; nothing was written"});
    const auto store = records::openStudy(study);
    const std::string name = nameOfFolder(study);
    const Staging staging(out);
    try {
        fs::create_directory(staging.folder() / name);
        copyFiles(study, staging.folder() / name);
        store.copyTo(staging.folder() / name / "study.db");
        const fs::path archive = staging.folder() / "archive.tar";
        pack(staging.folder(), name, archive);
        ::chmod(archive.c_str(), 0600);  // the allocation key is in it
        fs::rename(archive, out);
    } catch (const fs::filesystem_error& fault) {
        throw protocols::environmentFault({std::string("the backup cannot be written: ") + fault.what(), out,
                                           "room for a copy of the study",
                                           "make room or choose another disk; the study itself is untouched"});
    }
    std::printf("%s: a whole copy of %s (%zu answers); `tar xf` brings it back\n", out.c_str(), study.c_str(),
                store.answers().size());
    return 0;
}

}  // namespace

void addErase(CLI::App& app, Action& action)
{
    struct Call {
        std::string study, participant, who, why;
        bool answers = false;
    };
    auto* command = app.add_subcommand("erase", "remove what is known about a participant; who and why are recorded");
    auto call = std::make_shared<Call>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--participant", call->participant, "whose")->required();
    command->add_option("--who", call->who, "your name")->required();
    command->add_option("--why", call->why, "the reason")->required();
    command->add_flag("--answers", call->answers, "also every answer and note; the participant then counts as withdrawn");
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [call] {
            return erase(call->study, {protocols::ParticipantId(call->participant), call->answers, call->who, call->why, {}});
        };
    });
}

void addBackup(CLI::App& app, Action& action)
{
    struct Call {
        std::string study, out;
    };
    auto* command = app.add_subcommand("backup", "the whole study as one tar file, also while a session runs");
    auto call = std::make_shared<Call>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--out", call->out, "file to write")->required();
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [call] { return backup(call->study, call->out); };
    });
}

}  // namespace study::commands
