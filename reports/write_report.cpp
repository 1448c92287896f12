#include "reports/write_report.h"

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "reports/figures/report_figures.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"

namespace reports {
namespace {

namespace fs = std::filesystem;

// What a report consists of; nothing else in the folder is touched.
const std::vector<std::string> entries{"index.html", "results.json", "statistics.json", "tables", "figures"};

void write(const fs::path& file, const std::string& text) { protocols::writeWholeFile(file, text, protocols::Sync::Later); }

void writeAll(const Analysis& analysis, const protocols::FolderDraft& draft)
{
    write(draft.file("results.json"), analysis.results.dump(2) + "\n");
    write(draft.file("statistics.json"), analysis.statistics.dump(2) + "\n");
    for (const Table& table : allTables(analysis)) {
        write(draft.file("tables/" + table.name + ".csv"), toCsv(table));
        write(draft.file("tables/" + table.name + ".tex"), toTex(table));
    }
    const std::vector<Figure> figures = allFigures(analysis);
    for (const Figure& figure : figures) write(draft.file("figures/" + figure.name + ".svg"), figure.svg);
    write(draft.file("index.html"), page(analysis, figures));
}

bool isOurReport(const fs::path& folder)
{
    const std::string text = protocols::readIfPossible(folder / "results.json").value_or("");
    const Json results = Json::parse(text, nullptr, false);
    return results.is_object() && results.value("schema", "").starts_with("vis2hap.results/");
}

/// A folder with files of these names that no report wrote is somebody's work.
void requireReplaceable(const fs::path& folder)
{
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw protocols::badInput({"the place of the report is a file", folder.string(), "a folder, or a new name", ""});
    for (const std::string& entry : entries)
        if (fs::exists(folder / entry) && !isOurReport(folder))
            throw protocols::badInput({"the folder holds \"" + entry + "\" which is not of an earlier report", folder.string(),
                                       "an empty folder, a new name, or an earlier report", "choose another folder with --out"});
}

}  // namespace

void writeReport(const StudyData& data, const std::filesystem::path& folder)
{
    const Analysis analysis = analyse(data);
    requireReplaceable(folder);
    protocols::FolderDraft draft(folder, protocols::Earlier::EntriesReplaced);
    writeAll(analysis, draft);
    draft.putInPlace();
}

}  // namespace reports
