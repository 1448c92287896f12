#include "reports/write_report.h"

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "reports/figures/report_figures.h"
#include "reports/formats/table_formats.h"
#include "reports/formats/tex_table.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/page/page.h"
#include "reports/scripts/reproduction.h"
#include "reports/tables/report_tables.h"

namespace reports {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) { protocols::writeWholeFile(file, text, protocols::Sync::Later); }

void writeAll(const StudyAnalysis& analysis, const ReportOrigin& origin, const WriteDocuments& documents,
              const protocols::FolderDraft& draft)
{
    // A study may have no figure. The folder is then empty, and replaces that of an earlier report.
    for (const char* folder : {"tables", "figures"}) protocols::makeFolders(draft.path() / folder, protocols::Sync::Later);
    const auto writeJson = [&](const char* name, const auto& writeTo) {
        protocols::writeInPieces(
            draft.file(name), [&](const protocols::TakeBytes& take) { writeTo(take); }, protocols::Sync::Later);
    };
    writeJson("results.json", [&](const TakeText& take) { writeResults(analysis, origin, take); });
    writeJson("statistics.json", [&](const TakeText& take) { writeStatistics(analysis, take); });
    std::vector<ReportTable> tables;  // of the page; the others may be large, and are held one at a time
    forEachTable(analysis, [&](ReportTable one) {
        write(draft.file("tables/" + one.table.name + ".csv"), toCsv(one.table));
        write(draft.file("tables/" + one.table.name + ".tex"), toTex(one.table));
        if (one.onPage) tables.push_back(std::move(one));
    });
    const std::vector<Figure> figures = reportFigures(analysis);
    if (!figures.empty()) protocols::makeFolders(draft.path() / "figures" / oneColumnFolder, protocols::Sync::Later);
    for (const Figure& figure : figures) {
        write(draft.file("figures/" + figure.name + ".svg"), figure.svg);
        write(draft.file(std::string("figures/") + oneColumnFolder + "/" + figure.name + ".svg"), figure.narrowSvg);
    }
    const ReportDocument document = reportDocument(analysis, tables, figures, origin.logHead);
    write(draft.file("index.html"), reportPage(document));
    // Labels of a blinded study are not what an archive should hold.
    if (!analysis.data.blinded) {
        protocols::makeFolders(draft.path() / reproductionFolder, protocols::Sync::Later);
        writeReproduction(analysis, draft.path() / reproductionFolder);
    }
    if (documents) documents(document, draft.path());
}

}  // namespace

const std::vector<fs::path>& entriesOfReports()
{
    static const std::vector<fs::path> entries{"index.html", "results.json", "statistics.json", "tables",          "figures",
                                               "report.pdf", "report.docx",  "report.tex",      reproductionFolder};
    return entries;
}

void requireReplaceableReport(const fs::path& folder)
{
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw protocols::badInput({"the place of the report is a file", folder.string(), "a folder, or a new name", ""});
    for (const fs::path& entry : entriesOfReports())
        if (fs::exists(folder / entry) && !isResultsFile(folder / "results.json"))
            throw protocols::badInput({"the folder holds \"" + entry.string() + "\" which is not of an earlier report",
                                       folder.string(), "an empty folder, a new name, or an earlier report",
                                       "choose another folder with --out"});
}

void writeReport(const StudyAnalysis& analysis, const std::filesystem::path& folder, const ReportOrigin& origin,
                 const WriteDocuments& documents)
{
    requireReplaceableReport(folder);
    protocols::FolderDraft draft(folder, protocols::Earlier::EntriesReplaced);
    writeAll(analysis, origin, documents, draft);
    draft.outdates(entriesOfReports());
    draft.putInPlace();
}

}  // namespace reports
