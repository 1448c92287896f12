// vis2hap erase STUDY --participant ID, vis2hap backup STUDY --out FILE, and vis2hap rescue STUDY
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "database/evidence/acts.h"
#include "database/rescue.h"
#include "database/rescue_files.h"
#include "database/study_store.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "reports/text/plain_words.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/study_backup.h"
#include "study/commands/parts/text_checks.h"
#include "study/commands/recorded_act.h"
#include "study/records/erasure_certificate.h"
#include "study/records/log_heads.h"
#include "study/records/stored_study.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;

int erase(const std::string& study, const database::Erasure& erasure)
{
    database::StudyStore store({study}, database::StudyStore::Access::Write);
    const auto record = store.erase(erasure);
    const auto certificate = records::writeErasureCertificate(store, erasure, record);
    std::printf("%s: erased %s of %s; the erasure is recorded\n", protocols::printable(study).c_str(),
                erasure.answersToo ? "facts, debriefing, answers and notes" : "facts and debriefing",
                erasure.participant.value.c_str());
    for (const auto& file : record.found) std::printf("  still in %s\n", protocols::printable(file).c_str());
    for (const auto& file : record.unread)
        std::printf("  not searched, because it could not be read: %s\n", protocols::printable(file).c_str());
    if (record.shortTexts > 0)
        std::printf("  not searched for: %s of less than 8 bytes\n", reports::counted(record.shortTexts, "removed text").c_str());
    if (record.sharedTexts > 0)
        std::printf("  not searched for: %zu removed texts, because what stays in the study holds the same words\n",
                    record.sharedTexts);
    for (const auto& file : database::rescueFilesOfOthers(store.folder()))
        std::printf("note: %s belongs to another account, so its rows were not read; ask its owner to delete it\n",
                    protocols::printable(file.string()).c_str());
    for (const auto entry : record.interrupted)
        std::printf("  the erasure of entry %lld was interrupted before its search: look through files from before it\n",
                    static_cast<long long>(entry));
    std::printf("  %s: what was removed, where it was searched, and which copies may exist\n",
                protocols::printable(certificate.string()).c_str());
    const bool isComplete = record.found.empty() && record.unread.empty() && record.interrupted.empty();
    return static_cast<int>(isComplete ? protocols::ExitCode::Done : protocols::ExitCode::WorkFailed);
}

int backup(const std::string& study, const std::string& out)
{
    const auto store = records::openStudy(study);
    const Backup made = writeBackup(store, out);
    std::string faults;
    for (const auto& fault : made.faults) faults += (faults.empty() ? "" : "; ") + fault;
    recordAct(store, "backup", out, faults, made.head);
    for (const auto& fault : made.faults) std::fprintf(stderr, "warning: %s\n", protocols::printable(fault).c_str());
    std::printf("%s: a copy of %s with %s; `tar xf` restores it\n", protocols::printable(out).c_str(),
                protocols::printable(study).c_str(), reports::counted(made.answers, "answer").c_str());
    const std::string head = store.hasLastingHead() ? textOf(made.head) : records::headTextOf(store);
    std::printf("  log head %s\n", protocols::printable(head).c_str());
    noteIfReadByAll(out);
    if (const auto acts = headOfActs(store); acts.sequence > 0)
        std::printf("  acts head %s\n", protocols::printable(textOf(acts)).c_str());
    return 0;
}

/// A file that cannot be used may not be the only one.
database::StudyStore::Rescued rescued(const database::StudyFolder& folder, const fs::path& file, const std::vector<fs::path>& all)
{
    try {
        return database::StudyStore::rescue(folder, file);
    } catch (const protocols::Error&) {
        for (const fs::path& other : all)
            if (other != file)
                std::fprintf(stderr, "note: another rescue file is %s; --from takes it\n",
                             protocols::printable(other.string()).c_str());
        throw;
    }
}

int rescue(const std::string& study, const std::string& from)
{
    const database::StudyFolder folder{study};
    const auto files = database::rescueFiles(folder);
    if (from.empty())
        for (const fs::path& file : database::rescueFilesOfOthers(folder))
            std::fprintf(stderr, "note: %s belongs to another account and was not opened; --from takes it\n",
                         protocols::printable(file.string()).c_str());
    if (from.empty() && files.empty())
        throw protocols::badInput({"there is no rescue file of this study", study, "rescue-N.db in the folder or beside it",
                                   "name it with --from FILE"});
    const fs::path file = from.empty() ? files.back() : fs::path(from);
    const auto done = rescued(folder, file, files);
    std::printf("%s: brought back from %s, new entries of the log: %zu\n", protocols::printable(study).c_str(),
                protocols::printable(file.string()).c_str(), done.events);
    if (!done.earlier.empty())
        std::printf("  the database that stood there is now %s\n", protocols::printable(done.earlier.string()).c_str());
    if (done.acts > 0)
        std::printf("  exports and other acts that were recorded there since: %zu; the study keeps them\n", done.acts);
    if (done.lacksActs)
        std::printf(
            "  exports and other acts that were recorded there, and are altered or cannot be read, are not in the study\n");
    return 0;
}

}  // namespace

void addErase(CLI::App& app, Action& action)
{
    struct EraseCall {
        std::string study, participant, who, why;
        bool answers = false;
    };
    auto* command =
        app.add_subcommand("erase", "erase personal data of a participant; who and why are recorded, a certificate is written");
    auto call = std::make_shared<EraseCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--participant", call->participant, "the participant")->required();
    command->add_option("--who", call->who, "your name")->required()->check(isName());
    command->add_option("--why", call->why, "the reason")->required()->check(isReason());
    command->add_flag("--answers", call->answers, "erase every answer and note too; the participant then counts as withdrawn");
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] {
            return erase(call->study, {protocols::ParticipantId(call->participant), call->answers, call->who, call->why, {}});
        };
    });
}

void addBackup(CLI::App& app, Action& action)
{
    struct BackupCall {
        std::string study, out;
    };
    auto* command = app.add_subcommand("backup", "copy the whole study into one tar file, also while a session runs");
    auto call = std::make_shared<BackupCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--out", call->out, "file to write")->required();
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return backup(call->study, call->out); };
    });
}

void addRescue(CLI::App& app, Action& action)
{
    struct RescueCall {
        std::string study, from;
    };
    auto* command = app.add_subcommand("rescue", "bring back the answers that were kept aside when study.db vanished");
    auto call = std::make_shared<RescueCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--from", call->from, "the rescue file (default: the newest of this study)");
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return rescue(call->study, call->from); };
    });
}

}  // namespace study::commands
