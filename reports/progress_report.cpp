#include "reports/progress_report.h"

#include "protocols/files/folder_draft.h"
#include "protocols/files/markup_text.h"
#include "reports/formats/table_formats.h"
#include "reports/page/page_style.h"
#include "reports/write_report.h"

namespace reports {

namespace {

std::string progressPage(const ProgressReport& report)
{
    const std::string title = protocols::escapedMarkup(report.study);
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>" +
        title + " \u2013 progress</title>\n<style>" + pageStyle() + "</style>\n</head>\n<body>\n<header class=\"top\"><h1>" +
        title + "</h1>\n<p class=\"lede\">Progress of a blinded study</p>\n";
    for (const std::string& sentence : report.sentences)
        html += "<p class=\"notice plain\">" + protocols::escapedMarkup(sentence) + "</p>\n";
    html += "</header>\n<main>\n<section>\n";
    for (const Table& table : report.tables)
        if (!table.rows.empty()) html += toHtml(table);
    return html + "</section>\n</main>\n</body>\n</html>\n";
}

}  // namespace

void writeProgressReport(const ProgressReport& report, const std::filesystem::path& folder)
{
    requireReplaceableReport(folder);
    protocols::FolderDraft draft(folder, protocols::Earlier::EntriesReplaced);
    const auto write = [&](const std::string& name, const std::string& text) {
        protocols::writeWholeFile(draft.file(name), text, protocols::Sync::Later);
    };
    for (const Table& table : report.tables) write("tables/" + table.name + ".csv", toCsv(table));
    write("results.json", report.results);
    write("index.html", progressPage(report));
    draft.outdates(entriesOfReports());
    draft.putInPlace();
}

}  // namespace reports
