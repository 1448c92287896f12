#include "reports/page/page.h"

#include "protocols/files/markup_text.h"
#include "reports/formats/table_formats.h"
#include "reports/page/html_parts.h"
#include "reports/page/page_style.h"

namespace reports {
namespace {

std::string htmlOf(const DocumentTag& tag)
{
    return std::string("<span class=\"tag ") + (tag.isWarning ? "simulated" : "blinded") + "\">" +
           protocols::escapedMarkup(tag.text) + "</span>";
}

std::string htmlOf(const DocumentNotice& notice)
{
    return std::string("<p class=\"notice") + (notice.isWarning ? "" : " plain") + "\">" + notice.html + "</p>\n";
}

std::string htmlOf(const ReportTable* one)
{
    return one->foldedUnder.empty() ? toHtml(one->table) : folded(one->foldedUnder, toHtml(one->table));
}

std::string htmlOf(const Figure* figure)
{
    // A phone shows the narrow drawing, whose letters are as large; the other one is not displayed.
    return "<figure><div class=\"wide\">" + figure->svg + "</div><div class=\"narrow\">" + figure->narrowSvg +
           "</div><figcaption>" + protocols::escapedMarkup(figure->caption) + "</figcaption></figure>\n";
}

std::string headOf(const ReportDocument& document)
{
    const std::string title = protocols::escapedMarkup(document.title);
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>" +
        title + " \u2013 report</title>\n<style>" + pageStyle() + "</style>\n</head>\n<body>\n<header class=\"top\"><h1>" +
        title + "</h1>\n<p class=\"lede\">" + protocols::escapedMarkup(document.lede) + "</p>\n";
    for (const DocumentNotice& notice : document.notices) html += htmlOf(notice);
    return html + "</header>\n";
}

std::string htmlOf(const DocumentSection& section, const std::string& tags)
{
    const std::string& id = section.heading.id;
    std::string items;
    for (const DocumentItem& item : section.items) items += std::visit([](const auto* one) { return htmlOf(one); }, item);
    return "<section id=\"" + id + "\" aria-labelledby=\"" + id + "-h\"><div class=\"head\"><h2 id=\"" + id + "-h\">" +
           section.heading.title + "</h2>" + tags + "</div>\n" + section.leadHtml + items + section.endHtml + "</section>\n";
}

}  // namespace

std::string reportPage(const ReportDocument& document)
{
    std::string tags, links, sections;
    for (const DocumentTag& tag : document.tags) tags += htmlOf(tag);
    for (const DocumentSection& section : document.sections) {
        links += "<a href=\"#" + section.heading.id + "\">" + section.heading.title + "</a> ";
        sections += htmlOf(section, tags);
    }
    return headOf(document) + "<nav aria-label=\"Sections\">" + links + "</nav>\n<main>\n" + sections + "</main>\n<footer>" +
           document.footerHtml + "</footer>\n</body>\n</html>\n";
}

std::string reportPage(const StudyAnalysis& analysis, const std::vector<ReportTable>& tables, const std::vector<Figure>& figures,
                       const std::string& logHead)
{
    return reportPage(reportDocument(analysis, tables, figures, logHead));
}

}  // namespace reports
