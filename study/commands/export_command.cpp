// vis2hap export STUDY --out DIR [--format csv|json|script|psych-ds] [--public] [--with-log] [--with-samples]: answers after the
// unblinding, before it progress and rounded means. With --participant ID the data of one person, for this person.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "database/evidence/acts.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "reports/text/plain_words.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/text_checks.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/recorded_act.h"
#include "study/exports/public_files.h"
#include "study/exports/write_export.h"
#include "study/records/evidence/participant_data.h"
#include "study/records/log_heads.h"
#include "study/records/stored_study.h"

namespace study::commands {

namespace {

using nlohmann::ordered_json;

struct ExportCall {
    std::string study, out, format = "csv", participant;
    bool withLog = false, withSamples = false;
    PassphraseOption passphrase;
    bool isPublic = false;
    std::string licence = exports::usualLicence;
    std::vector<std::string> authors;
};

int exportStudy(const ExportCall& call)
{
    const auto& [study, out, format, participant, withLog, withSamples, passphrase, isPublic, licence, authors] = call;
    const auto store = records::openStudy(study);
    StateForFiles state(store);
    const auto written =
        exports::writeExport(store, out, {format, withLog, withSamples, isPublic, licence, authors}, passphraseFrom(passphrase));
    const auto leftOut = isPublic ? exports::answersLeftOut(store) : exports::LeftOutAnswers();
    const std::size_t answers = store.answerCount() - leftOut.ofWithdrawn - leftOut.inWords;
    const bool isBlinded = !store.unblinding();
    const std::string head = records::headTextOf(store);
    state.record("export", out);
    std::printf("%s: %s as %s%s\n", protocols::printable(out).c_str(), reports::counted(answers, "answer").c_str(),
                format.c_str(), isBlinded ? ", blinded (no condition, no true piece)" : "");
    if (!written.whyNoMeans.empty()) std::printf("  %s\n", protocols::printable(written.whyNoMeans).c_str());
    for (const auto& name : written.removed)
        std::printf("  removed %s of an earlier export: these answers were erased since\n", protocols::printable(name).c_str());
    if (!written.left.empty())
        std::printf("note: %s also holds %s, which this export did not write: an earlier one may hold what was erased since\n",
                    protocols::printable(out).c_str(), protocols::printable(reports::listed(written.left)).c_str());
    std::printf("  log head %s\n", head.c_str());
    if (withLog) std::printf("  log.csv holds the log, acts.csv what was exported and saved; log.txt says how to check both\n");
    if (isPublic)
        std::printf(
            "  no days, notes or words are in it%s; LICENSE.txt says %s\n",
            leftOut.inWords == 0 ? "" : (" (" + reports::counted(leftOut.inWords, "answer") + " in words left out)").c_str(),
            protocols::printable(licence).c_str());
    if (leftOut.ofWithdrawn > 0)
        std::printf("  %s of participants who withdrew %s left out\n", reports::counted(leftOut.ofWithdrawn, "answer").c_str(),
                    leftOut.ofWithdrawn == 1 ? "is" : "are");
    if (isPublic && authors.empty()) std::printf("  name the authors in CITATION.cff, or export again with --author NAME\n");
    if (withSamples) std::printf("  finger_samples.csv holds what the display measured of the fingers\n");
    return 0;
}

/// "2 answers, 1 fact, 0 notes"
std::string countsOf(const ordered_json& data)
{
    return reports::counted(data["answers"].size(), "answer") + ", " + reports::counted(data["facts"].size(), "fact") + ", " +
           reports::counted(data["notes"].size(), "note");
}

/// The folder goes to a person. Throws badInput where it holds anything but an earlier export about this person.
void requireOwnHandOver(const std::string& out, const ordered_json& data)
{
    namespace fs = std::filesystem;
    if (!fs::exists(out) || (fs::is_directory(out) && fs::is_empty(out))) return;
    const auto earlier =
        ordered_json::parse(protocols::readIfPossible(fs::path(out) / "your-data.json").value_or(""), nullptr, false);
    const auto isSame = [&](const char* field) { return earlier.value(field, ordered_json()) == data[field]; };
    if (earlier.is_object() && isSame("schema") && isSame("study") && isSame("participant")) return;
    throw protocols::badInput(
        {"the data of one person need a folder of their own", out,
         "a new or an empty folder, or that of an earlier export about " + data["participant"].get<std::string>(),
         "name another folder with --out"});
}

/// The data of one person, as the law of data protection asks for them.
int exportPerson(const ExportCall& call)
{
    const auto store = records::openStudy(call.study);
    StateForFiles state(store);
    const auto data = records::participantData(store, protocols::ParticipantId(call.participant));
    requireOwnHandOver(call.out, data);
    protocols::FolderDraft draft(call.out, protocols::Earlier::FilesJoined);
    records::writeParticipantData(store, data, draft.path());
    draft.outdates({"your-finger-samples.csv"});  // of an earlier export, before an erasure
    draft.putInPlace();
    state.record(database::personExport, call.out, call.participant);
    std::printf("%s: data of %s: %s%s\n", protocols::printable(call.out).c_str(), protocols::printable(call.participant).c_str(),
                countsOf(data).c_str(),
                data["blinded"].get<bool>() ? ", blinded (no condition, no fabric, nothing about right or wrong)" : "");
    for (const auto& act : data["erasures"])
        std::printf("  erased on %s: %s; what is left is in the files, with the certificate\n",
                    protocols::printable(act["time"].get<std::string>()).c_str(),
                    act["answers_too"].get<bool>() ? "facts, debriefing, answers, notes and times" : "facts and debriefing");
    std::printf("  your-data.html is the sheet for this person\n");
    return 0;
}

}  // namespace

void addExport(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("export", "answers and participants as files; blinded until the study is unblinded");
    auto call = std::make_shared<ExportCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--out", call->out, "folder to write into")->required();
    auto* format = command
                       ->add_option("--format", call->format,
                                    "csv, json, script (sessions that `replay` takes), or psych-ds (a data set with metadata by "
                                    "Psych-DS; new folder)")
                       ->check(CLI::IsMember({"csv", "json", "script", "psych-ds"}))
                       ->capture_default_str();
    auto* withLog =
        command->add_flag("--with-log", call->withLog,
                          "add the log (log.csv), the acts (acts.csv) and how to check them (log.txt); no content, no salts");
    auto* withSamples =
        command->add_flag("--with-samples", call->withSamples,
                          "add what displays measured of the fingers (finger_samples.csv); unblinded studies only");
    auto* isPublic = command->add_flag(
        "--public", call->isPublic,
        "leave out days, notes, words and answers of those who withdrew; add LICENSE.txt and CITATION.cff; unblinded studies");
    command->add_option("--licence", call->licence, "with --public: SPDX identifier of the licence")
        ->check(isSpdxIdentifier())
        ->needs(isPublic)
        ->capture_default_str();
    command->add_option("--author", call->authors, "with --public: an author; may be given several times")
        ->check(isName())
        ->needs(isPublic)
        ->allow_extra_args(false);
    command
        ->add_option("--participant", call->participant,
                     "write the data of this participant only, with a sheet for the person (your-data.html)")
        ->excludes(format)
        ->excludes(withLog)
        ->excludes(withSamples)
        ->excludes(isPublic);
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return call->participant.empty() ? exportStudy(*call) : exportPerson(*call); };
    });
}

}  // namespace study::commands
