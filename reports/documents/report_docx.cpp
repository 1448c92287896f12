#include "reports/documents/report_docx.h"

#include <QDir>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>

#include "protocols/files/errors.h"
#include "protocols/files/markup_text.h"
#include "protocols/files/whole_file.h"
#include "reports/documents/figure_files.h"
#include "reports/formats/table_formats.h"

namespace reports {
namespace {

constexpr int longestMs = 60000;
constexpr double figureMm = 160;  ///< text of an A4 page

std::string htmlOf(const ReportTable* one) { return toHtml(one->table); }

std::string htmlOf(const Figure* figure)
{
    return "<p><img src=\"" + figure->name + ".png\" alt=\"" + protocols::escapedMarkup(figure->caption) +
           "\" width=\"100%\"></p>\n<p>" + protocols::escapedMarkup(figure->caption) + "</p>\n";
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
        html += "<h1>" + protocols::escapedMarkup(section.heading.title) + tags + "</h1>\n" + section.leadHtml;
        for (const DocumentItem& item : section.items) html += std::visit([](const auto* one) { return htmlOf(one); }, item);
        html += section.endHtml;
    }
    return html + "<p>" + document.footerHtml + "</p>\n</body></html>\n";
}

void writeReportDocx(const ReportDocument& document, const std::filesystem::path& folder)
{
    QTemporaryDir work;
    const std::filesystem::path inside(work.path().toStdString());
    for (const DocumentSection& section : document.sections)
        for (const DocumentItem& item : section.items)
            if (const auto* figure = std::get_if<const Figure*>(&item))
                writeFigurePng(**figure, inside / ((*figure)->name + ".png"), figureMm);
    protocols::writeWholeFile(inside / "report.html", plainHtml(document), protocols::Sync::Later);
    QProcess pandoc;
    pandoc.setWorkingDirectory(work.path());
    const QString out = QString::fromStdString(std::filesystem::absolute(folder / "report.docx").string());
    pandoc.start("pandoc", {"--from=html", "--to=docx", "--output", out, "report.html"});
    if (pandoc.waitForFinished(longestMs) && pandoc.exitStatus() == QProcess::NormalExit && pandoc.exitCode() == 0) return;
    pandoc.kill();
    pandoc.waitForFinished();
    const QString said = lastLineOf(pandoc.readAllStandardError());
    throw protocols::environmentFault({"pandoc made no document" + (said.isEmpty() ? "" : ": " + said.toStdString()),
                                       (folder / "report.docx").string(), "pandoc to end within a minute",
                                       "leave --docx out, or repair pandoc"});
}

}  // namespace reports
