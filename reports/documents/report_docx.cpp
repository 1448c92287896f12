#include "reports/documents/report_docx.h"

#include <QDir>
#include <QProcess>
#include <QProcessEnvironment>
#include <QStandardPaths>
#include <algorithm>

#include "protocols/files/errors.h"
#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "protocols/secrets/secret_variables.h"
#include "reports/documents/drawing_painter.h"
#include "reports/documents/figure_files.h"
#include "reports/documents/html_tiles.h"
#include "reports/formats/table_parts.h"

namespace reports {
namespace {

constexpr int longestMs = 60000;
constexpr double figureMm = 160;  ///< text of an A4 page

constexpr double leastWidthPt = 150;  ///< narrower tables do not fill the text
constexpr double cellPaddingPt = 12;  ///< between two columns

/// Word processors show the letters of a table at 12 points, whatever its width is.
TableRoom tableRoom() { return {.widthPt = figureMm / 25.4 * 72, .scales = {1.2}, .gapPt = cellPaddingPt}; }

/// Word processors break a cell of no-break spaces inside a word.
std::string wrappable(const std::string& html)
{
    return QString::fromStdString(html).replace(QChar(QChar::Nbsp), QChar(' ')).replace("&nbsp;", " ").toStdString();
}

/// A part of a table with widths of its columns, which a word processor would otherwise make equal.
std::string htmlOf(const Table& table, const TablePart& part, const std::string& caption)
{
    double whole = 0;
    const auto widthOf = [&](const PartColumn& column) {
        return cellPaddingPt + (column.wrappedPt > 0 ? column.wrappedPt / part.scale : column.width);
    };
    for (const PartColumn& column : part.columns) whole += widthOf(column);
    std::string html = "<table><caption>" + protocols::escapedMarkup(caption) + "</caption><colgroup>", head, body;
    for (const PartColumn& column : part.columns) {
        const std::string align = column.isNumber ? " style=\"text-align:right\"" : "";
        html += "<col width=\"" + protocols::fixed(100 * widthOf(column) / std::max(whole, leastWidthPt), 1) + "%\">";
        head += "<th" + align + ">" + protocols::escapedMarkup(table.columns[column.index].name) + "</th>";
    }
    for (const auto& row : table.rows) {
        body += "<tr>";
        for (const PartColumn& column : part.columns)
            body += std::string("<td") + (column.isNumber ? " style=\"text-align:right\">" : ">") +
                    wrappable(row[column.index].html) + "</td>";
        body += "</tr>\n";
    }
    return html + "</colgroup><thead><tr>" + head + "</tr></thead><tbody>\n" + body + "</tbody></table>\n";
}

std::string htmlOf(const ReportTable* one)
{
    const std::vector<TablePart> parts = tableParts(one->table, tableRoom());
    std::string html;
    for (std::size_t i = 0; i < parts.size(); ++i)
        html += htmlOf(one->table, parts[i], one->table.caption + partWords(i + 1, parts.size()));
    return html;
}

double widthMm(const Figure& figure) { return figureMm * shareOfTextWidth(figure.svg); }

/// Pandoc ignores widths in percent.
std::string htmlOf(const Figure* figure)
{
    return "<p><img src=\"" + figure->name + ".png\" alt=\"" + protocols::escapedMarkup(figure->caption) + "\" width=\"" +
           protocols::fixed(widthMm(*figure), 0) + "mm\"></p>\n<p>" + protocols::escapedMarkup(figure->caption) + "</p>\n";
}

QString lastLineOf(const QByteArray& text) { return QString::fromUtf8(text).trimmed().section('\n', -1); }

}  // namespace

bool hasPandoc() { return !QStandardPaths::findExecutable("pandoc").isEmpty(); }

std::string plainHtml(const ReportDocument& document)
{
    std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                       protocols::escapedMarkup(document.title) + "</title></head><body>\n<p>" +
                       protocols::escapedMarkup(document.lede) + "</p>\n";
    for (const DocumentNotice& notice : document.notices) html += "<p>" + notice.html + "</p>\n";
    std::string tags;
    for (const DocumentTag& tag : document.tags) tags += " [" + protocols::escapedMarkup(tag.text) + "]";
    for (const DocumentSection& section : document.sections) {
        html += "<h1>" + protocols::escapedMarkup(section.heading.title) + tags + "</h1>\n" + withoutTiles(section.leadHtml);
        for (const DocumentItem& item : section.items) html += std::visit([](const auto* one) { return htmlOf(one); }, item);
        html += section.endHtml;
    }
    return html + "<p>" + document.footerHtml + "</p>\n</body></html>\n";
}

void writeReportDocx(const ReportDocument& document, const std::filesystem::path& folder)
{
    const protocols::TemporaryFolder work;
    const std::filesystem::path& inside = work.path();
    for (const DocumentSection& section : document.sections)
        for (const DocumentItem& item : section.items)
            if (const auto* figure = std::get_if<const Figure*>(&item))
                writeFigurePng(**figure, inside / ((*figure)->name + ".png"), widthMm(**figure));
    protocols::writeWholeFile(inside / "report.html", plainHtml(document), protocols::Sync::Later);
    QProcess pandoc;
    pandoc.setProcessEnvironment(protocols::withoutSecrets(QProcessEnvironment::systemEnvironment()));
    pandoc.setWorkingDirectory(QString::fromStdString(inside.string()));
    const QString out = QString::fromStdString(std::filesystem::absolute(folder / "report.docx").string());
    pandoc.start("pandoc", {"--from=html", "--to=docx", "--output", out, "report.html"});
    if (pandoc.waitForFinished(longestMs) && pandoc.exitStatus() == QProcess::NormalExit && pandoc.exitCode() == 0) return;
    pandoc.kill();
    pandoc.waitForFinished();
    const QString said = lastLineOf(pandoc.readAllStandardError());
    throw protocols::environmentFault({"pandoc made no document" + (said.isEmpty() ? "" : ": " + said.toStdString()),
                                       (folder / "report.docx").string(), "pandoc to end within a minute",
                                       "repair pandoc, or remove it, and report again"});
}

}  // namespace reports
