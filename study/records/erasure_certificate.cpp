#include "study/records/erasure_certificate.h"

#include "database/erasure.h"
#include "database/evidence/acts.h"
#include "database/rescue_files.h"
#include "database/server/study_move.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "reports/text/plain_words.h"

namespace study::records {

namespace {

/// No value, of which the database holds some, ends its line or steers a terminal.
std::string line(const std::string& name, const std::string& value) { return name + ": " + protocols::printable(value) + "\n"; }

std::string whereFound(const std::vector<std::string>& files)
{
    std::string text;
    for (const auto& file : files) text += (text.empty() ? "" : ", ") + file;
    return text.empty() ? "nowhere" : text;
}

/// Backups, exports and reports that were recorded after the participant's first entry in the log.
std::string copiesOf(const database::StudyStore& store, const protocols::ParticipantId& participant)
{
    const auto entries = store.events(participant);
    if (entries.empty()) return "The participant has no entry in the log, so no recorded copy holds data about them.\n";
    std::string text;
    bool wasOnServer = false;
    for (const auto& act : copiesSince(store, entries.front().sequence, participant)) {
        wasOnServer = wasOnServer || act.kind == database::serverAct;
        text += "  " +
                protocols::printable(act.kind + " " + act.path + " on " + act.host + ", " + act.wallTime + ", by " + act.who) +
                "\n";
    }
    if (wasOnServer)
        text += std::string(
                    "The study was on a server. Its log, write-ahead log and backups may hold what is erased here. They were "
                    "not searched. An administrator of the server removes them:\n") +
                database::removalFromServer;
    return text.empty() ? "The study has a record of no such copy since the participant's first entry in the log.\n"
                        : "Copies on record since the participant's first entry in the log:\n" + text;
}

/// Where an earlier database was put back, another erasure had this entry. Its certificate is the only trace of that.
void keepEarlier(const std::filesystem::path& file)
{
    if (!std::filesystem::exists(std::filesystem::symlink_status(file))) return;
    std::filesystem::path kept;
    for (int number = 1; kept.empty() || std::filesystem::exists(std::filesystem::symlink_status(kept)); ++number)
        kept = file.parent_path() / (file.stem().string() + "-of-another-log-" + std::to_string(number) + ".txt");
    std::filesystem::rename(file, kept);
}

}  // namespace

std::filesystem::path writeErasureCertificate(const database::StudyStore& store, const database::Erasure& erasure,
                                              const database::ErasureRecord& record)
{
    std::string text = "Certificate of erasure\n\n";
    text += line("Study", store.facts().name);
    text += line("Participant", erasure.participant.value);
    text +=
        line("Erased",
             erasure.answersToo
                 ? "facts, debriefing, answers, notes, times, samples of the finger, and the salts of their entries in the log"
                 : "facts and debriefing");
    const auto counted = [](int rows, const char* what) { return reports::counted(static_cast<std::size_t>(rows), what); };
    text +=
        line("Rows removed",
             counted(record.answers, "answer") + ", " + counted(record.notes, "note") + ", " + counted(record.facts, "fact") +
                 (record.fingerSamples > 0 ? ", " + std::to_string(record.fingerSamples) + " samples of the finger on the display"
                                           : std::string()));
    text +=
        line("What stays",
             std::string("the code of the participant, the number of the running order, the state, and the time of enrolment") +
                 (erasure.answersToo ? "" : "; the steps of the sessions with their times, answers and notes"));
    if (erasure.answersToo)
        text += line("Each step of the sessions keeps an entry without content and time",
                     "its number, sitting, kind (such as answered), trial, attempt and question");
    text += line("Ordered by", erasure.who);
    text += line("Reason", erasure.why);
    text += line("Time", record.wallTime);
    text += line("Entry of the log", std::to_string(record.event));
    text += line("Log head", textOf(store.head()));
    text += line("Files searched for " + std::to_string(record.searchedTexts) + " removed texts",
                 std::to_string(record.searchedFiles));
    if (record.sharedTexts > 0)
        text += line("Not searched for, because what stays in the study holds the same words",
                     std::to_string(record.sharedTexts) + " removed texts");
    if (record.shortTexts > 0)
        text +=
            line("Not searched for, because they have less than 8 bytes", reports::counted(record.shortTexts, "removed text"));
    for (const auto& name : record.unread) text += line("Not searched, because it could not be read", name);
    text += line("Found in", whereFound(record.found));
    for (const auto& file : database::rescueFilesOfOthers(store.folder()))
        text += line("Rows not read, because another account owns it", file.string());
    for (const auto entry : record.interrupted)
        text += "The erasure of entry " + std::to_string(entry) +
                " was interrupted before its search. Its texts are no longer known, so that only databases could be searched for "
                "them, by their rows. Look through other files that were made before it.\n";
    text +=
        "\nCopies made before this erasure are not changed by it: backups, exports, reports, and copies of the folder. "
        "Erase or delete them, too.\n";
    text += copiesOf(store, erasure.participant);
    protocols::makeFolders(database::certificatesFolder(store.folder()));
    const auto file = database::certificateFile(store.folder(), record.event);
    keepEarlier(file);
    protocols::writeWholeFile(file, text, protocols::Sync::Now, protocols::Readers::OwnerOnly);
    // A certificate that is not recorded after a crash is noted by `verify`; a recorded one that is missing is a fault.
    database::recordCertificate(store, record, protocols::sha256(text));
    return file;
}

}  // namespace study::records
