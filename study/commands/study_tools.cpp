#include "study/commands/study_tools.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "reports/documents/report_documents.h"
#include "reports/text/plain_words.h"
#include "reports/write_report.h"
#include "study/commands/parts/friction_pictures.h"
#include "study/commands/parts/study_backup.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/recorded_act.h"
#include "study/exports/write_export.h"
#include "study/making/study_sheets.h"
#include "study/records/blinded_report.h"
#include "study/records/evidence/data_sheet.h"
#include "study/records/evidence/data_sheet_text.h"
#include "study/records/log_heads.h"
#include "study/records/shown_origin.h"
#include "study/records/stored_study.h"
#include "study/records/study_faults.h"
#include "study/records/study_status.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;

struct ToolCall {
    const database::StudyStore& store;
    fs::path out;  ///< what to write: a name that is free
    std::string operatorName;
    const app::ToolProgress& progress;
};

/// "INTO/STUDY-KIND", or with "-2", "-3" … where that exists.
fs::path freeName(const fs::path& study, const fs::path& into, const std::string& kind, const std::string& ending)
{
    std::error_code unknown;
    if (into.empty() || !fs::is_directory(into, unknown))
        throw protocols::badInput(
            {"there is no such folder", into.string(), "a folder that exists", "choose another folder; nothing was written"});
    const auto inStudy = fs::weakly_canonical(into).lexically_relative(fs::weakly_canonical(study));
    if (!inStudy.empty() && *inStudy.begin() != "..")
        throw protocols::badInput({"the files would lie in the study", into.string(), "a folder outside " + study.string(),
                                   "choose another folder; nothing was written"});
    const std::string stem = study.filename().string() + "-" + kind;
    fs::path path = into / (stem + ending);
    for (int number = 2; fs::exists(path); ++number) path = into / (stem + "-" + std::to_string(number) + ending);
    return path;
}

app::ToolOutcome recorded(const ToolCall& call, const std::string& kind, std::string text, const std::string& note = {},
                          const std::optional<database::LogHead>& head = {})
{
    const std::string refused = addAct(call.store, kind, call.out, call.operatorName, note, head);
    text += refused.empty() ? "Recorded in the study.\n" : "Not recorded in the study: " + refused + "\n";
    return {text + "Log head " + records::headTextOf(call.store) + "\n", call.out};
}

app::ToolOutcome verified(const database::StudyStore& store)
{
    const records::Findings findings = records::findingsOf(store);
    std::string text = findings.faults.empty() ? "sound" : reports::counted(findings.faults.size(), "fault") + ":";
    text += "\n";
    for (const auto& fault : findings.faults) text += protocols::printable(fault) + "\n";
    for (const auto& note : findings.notes) text += "note: " + protocols::printable(note) + "\n";
    return {text + "Log head " + records::headTextOf(store) + "\n", {}, findings.faults.empty()};
}

app::ToolOutcome sheets(const ToolCall& call)
{
    making::writeSheets(call.store, call.out);
    return {"Open the pages in a browser and print them.\n", call.out};
}

app::ToolOutcome backup(const ToolCall& call)
{
    std::string faults, text;
    const Backup made = writeBackup(call.store, call.out);
    for (const auto& fault : made.faults) {
        text += "warning: " + fault + "\n";
        faults += (faults.empty() ? "" : "; ") + fault;
    }
    text += reports::counted(made.answers, "answer") + "; `tar xf` restores the study.\n";
    return recorded(call, "backup", text, faults, made.head);
}

app::ToolOutcome exported(const ToolCall& call)
{
    // As in reported(): an open key would show means to the operator.
    StateForFiles state(call.store);
    exports::writeExport(call.store, call.out, {.format = "csv", .withMeans = false}, {});
    const std::string text =
        call.store.unblinding() ? "Answers of the unblinded study.\n" : "Blinded: progress, balance and flags.\n";
    return recorded(call, "export", text, {}, state.end());
}

app::ToolOutcome reported(const ToolCall& call)
{
    StateForFiles state(call.store);
    std::optional<reports::StudyData> data;
    // An open key would show scores while sessions run; the operator must not see them.
    if (call.store.unblinding()) data = records::studyData(call.store, {});
    if (!data) {
        reports::writeProgressReport(records::blindedReport(call.store), call.out);
        return recorded(call, "report", "Blinded: progress, balance and flags. Results follow after the unblinding.\n", {},
                        state.end());
    }
    data->pictures = frictionPictures(call.store, *data, [](const std::string&) {});
    const reports::AnalysisOptions options{reports::Depth::Whole, 0, [&](int done, int total, const std::string& step) {
                                               call.progress(total > 0 ? 1.0 * done / total : 0.0, step);
                                           }};
    reports::writeReport(reports::analyse(std::move(*data), options), call.out,
                         {records::headTextOf(call.store), records::shownMadeWith(call.store, call.store.facts())},
                         reports::allDocuments());
    return recorded(call, "report", "Open index.html in a browser.\n", {}, state.end());
}

app::ToolOutcome dataSheet(const ToolCall& call)
{
    const std::string text = records::textOfDataSheet(records::dataSheetOf(call.store));
    protocols::writeWholeFile(call.out, text);
    return {text, call.out};
}

}  // namespace

app::UseTool studyTools(const std::string& operatorName)
{
    return [operatorName](app::StudyTool tool, const fs::path& study, const fs::path& into,
                          const app::ToolProgress& progress) -> app::ToolOutcome {
        const auto store = records::openStudy(study);
        const auto writing = [&](const std::string& kind, const std::string& ending = {}) {
            return ToolCall{store, freeName(study, into, kind, ending), operatorName, progress};
        };
        switch (tool) {
            case app::StudyTool::Status:
                return {records::textOf(records::statusOf(store, {}))};
            case app::StudyTool::Verify:
                return verified(store);
            case app::StudyTool::Sheets:
                return sheets(writing("sheets"));
            case app::StudyTool::Backup:
                return backup(writing("backup", ".tar"));
            case app::StudyTool::Export:
                return exported(writing("export"));
            case app::StudyTool::Report:
                return reported(writing("report"));
            case app::StudyTool::DataSheet:
                return dataSheet(writing("data-sheet", ".txt"));
        }
        throw std::logic_error("unknown tool");
    };
}

}  // namespace study::commands
