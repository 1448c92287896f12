// vis2hap leak-check STUDY [--json [FILE]]: attacks the study as each role could and prints what the role learns
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "database/server/server_address.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/cache/result_cache.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/recorded_act.h"
#include "study/commands/server/server_work.h"
#include "study/exports/write_export.h"
#include "study/leaks/leak_text.h"
#include "study/records/blinded_report.h"
#include "study/records/evidence/data_sheet.h"
#include "study/records/evidence/exported_log.h"
#include "study/records/evidence/participant_data.h"
#include "study/records/folder_audit.h"
#include "study/records/stored_study.h"
#include "study/records/study_status.h"

namespace study::commands {

namespace {

/// Everything that the program writes about a blinded study without its key.
std::vector<leaks::Exporter> exportersOf(const database::StudyStore& store)
{
    const database::Passphrase nobody = [] { return std::nullopt; };
    std::vector<leaks::Exporter> exporters;
    for (const char* format : {"csv", "json", "script", "psych-ds"})
        exporters.push_back({std::string("export --format ") + format, [&store, format, nobody](const auto& folder) {
                                 exports::writeExport(store, folder / "out", {format, false, false}, nobody);
                             }});
    exporters.push_back({"export --with-log", [&store](const auto& folder) { records::writeExportedLog(store, folder); }});
    exporters.push_back(
        {"export --participant", [&store](const auto& folder) { records::writeEveryParticipant(store, folder); }});
    exporters.push_back({"report", [&store](const auto& folder) {
                             reports::writeProgressReport(records::blindedReport(store), folder / "out");
                         }});
    exporters.push_back({"study status", [&store, nobody](const auto& folder) {
                             protocols::writeWholeFile(folder / "status.json", records::statusOf(store, nobody).dump(1),
                                                       protocols::Sync::Later);
                         }});
    exporters.push_back({"study data-sheet", [&store](const auto& folder) {
                             protocols::writeWholeFile(folder / "sheet.json", records::dataSheetOf(store).dump(1),
                                                       protocols::Sync::Later);
                         }});
    return exporters;
}

int leakCheck(const std::string& study, const PassphraseOption& passphrase, const JsonTarget& target)
{
    if (database::isServerAddress(study)) return checkLogin(study, target);
    const auto store = records::openStudy(study);
    const auto key = readKeyForAggregates(store, passphraseFrom(passphrase));
    const auto report = leaks::leakReport(store, key, exportersOf(store), rendering::cache::usualFolder().value_or(""),
                                          records::findingsInFolder(store).unknownFiles);
    recordAct(store, "leak-check");
    if (target)
        writeJson(target, leaks::jsonOf(report));
    else
        std::fputs(protocols::printableLines(leaks::textOf(report)).c_str(), stdout);
    return static_cast<int>(report.learnsNothing() ? protocols::ExitCode::Done : protocols::ExitCode::WorkFailed);
}

}  // namespace

void addLeakCheck(CLI::App& app, Action& action)
{
    struct Call {
        std::string study;
        PassphraseOption passphrase;
        JsonTarget target;
    };
    auto* command = app.add_subcommand("leak-check", "attack a blinded study and print what each role could learn");
    auto call = std::make_shared<Call>();
    command->add_option("STUDY", call->study, "the study, or its address on a server with the login to check")->required();
    addPassphraseOption(*command, call->passphrase);
    addJsonOption(*command, call->target);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return leakCheck(call->study, call->passphrase, call->target); };
    });
}

}  // namespace study::commands
