#include "reports/page/page.h"

#include "protocols/files/markup_text.h"
#include "reports/formats/table_formats.h"
#include "reports/page/html_parts.h"
#include "reports/page/page_style.h"
#include "reports/page/section_text.h"
#include "reports/text/page_section.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// Tags at the head of every section, so that no part of the page can be quoted without them.
std::string tagsOf(const StudyData& data)
{
    std::string html;
    if (data.simulated) html += "<span class=\"tag simulated\">SIMULATED participants</span>";
    if (data.scripted) html += "<span class=\"tag simulated\">SCRIPTED participants</span>";
    if (data.blinded) html += "<span class=\"tag blinded\">blinded</span>";
    return html;
}

std::string noticesOf(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    const auto warning = [](const std::string& html) { return "<p class=\"notice\">" + html + "</p>\n"; };
    const auto remark = [](const std::string& html) { return "<p class=\"notice plain\">" + html + "</p>\n"; };
    std::string html;
    if (data.simulated)
        html += warning(
            "<b>SIMULATED participants.</b> No person took part. The numbers show what the program does, not how a rendering "
            "feels.");
    if (data.scripted) html += warning("<b>SCRIPTED participants.</b> The answers were written into a file beforehand.");
    if (data.blinded)
        html += remark(
            "<b>This report is blinded.</b> Conditions carry masked labels. Signals, groups and planned contrasts are left out "
            "until the study is unblinded.");
    for (const std::string& stamp : data.stamps) html += remark(protocols::escapedMarkup(stamp));
    for (const std::string& limit : analysis.designLimits) html += remark(protocols::escapedMarkup(limit));
    return html;
}

std::string headOf(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
           "content=\"width=device-width, initial-scale=1\">\n<title>" +
           protocols::escapedMarkup(data.name) + " \u2013 report</title>\n<style>" + pageStyle() + "</style>\n</head>\n<body>\n" +
           "<header class=\"top\"><h1>" + protocols::escapedMarkup(data.name) +
           "</h1>\n<p class=\"lede\">Haptic rendering study: " + counted(data.participants.size(), "participant") + ", " +
           counted(data.fabrics.size(), "fabric") + ", " + counted(data.conditions.size(), "condition") + "</p>\n" +
           noticesOf(analysis) + "</header>\n";
}

std::string footerOf(const StudyData& data, const std::string& logHead)
{
    const std::string head =
        logHead.empty() ? "" : " Head of the study's log: <code>" + protocols::escapedMarkup(logHead) + "</code>.";
    const std::string hash = data.protocolSha256.empty()
                                 ? ""
                                 : " Protocol SHA-256: <code>" + protocols::escapedMarkup(data.protocolSha256) + "</code>.";
    return "<footer>All numbers with full digits are in <code>results.json</code>, <code>statistics.json</code>, "
           "<code>tables/</code> and <code>figures/</code> beside this page." +
           hash + head + "</footer>\n";
}

std::string htmlOf(const ReportTable& one)
{
    return one.foldedUnder.empty() ? toHtml(one.table) : folded(one.foldedUnder, toHtml(one.table));
}

std::string htmlOf(const Figure& figure)
{
    return "<figure>" + figure.svg + "<figcaption>" + protocols::escapedMarkup(figure.caption) + "</figcaption></figure>\n";
}

class SectionWriter {
public:
    SectionWriter(const StudyAnalysis& analysis, const std::vector<ReportTable>& tables, const std::vector<Figure>& figures)
        : m_analysis(analysis), m_tables(tables), m_figures(figures)
    {
    }

    /// Empty if the study has no content for the section.
    std::string section(const SectionHeading& heading) const
    {
        // The whole study comes first, then each question.
        std::string items = itemsOf(heading.section, "");
        for (const QuestionAnalysis& question : m_analysis.questions) items += itemsOf(heading.section, question.question.id);
        if (items.empty() && !standsAlone(heading.section)) return {};
        return "<section id=\"" + heading.id + "\" aria-labelledby=\"" + heading.id + "-h\"><div class=\"head\"><h2 id=\"" +
               heading.id + "-h\">" + heading.title + "</h2>" + tagsOf(m_analysis.data) + "</div>\n" +
               sectionLead(heading.section, m_analysis) + items + sectionEnd(heading.section) + "</section>\n";
    }

private:
    std::string itemsOf(PageSection section, const std::string& question) const
    {
        std::string html;
        for (const Figure& figure : m_figures)
            if (figure.section == section && figure.question == question) html += htmlOf(figure);
        for (const ReportTable& one : m_tables)
            if (one.section == section && one.question == question && one.onPage) html += htmlOf(one);
        return html;
    }

    const StudyAnalysis& m_analysis;
    const std::vector<ReportTable>& m_tables;
    const std::vector<Figure>& m_figures;
};

}  // namespace

std::string reportPage(const StudyAnalysis& analysis, const std::vector<ReportTable>& tables, const std::vector<Figure>& figures,
                       const std::string& logHead)
{
    const SectionWriter writer(analysis, tables, figures);
    std::string links;
    std::string sections;
    for (const SectionHeading& heading : sectionHeadings()) {
        const std::string section = writer.section(heading);
        if (section.empty()) continue;
        links += "<a href=\"#" + heading.id + "\">" + heading.title + "</a> ";
        sections += section;
    }
    return headOf(analysis) + "<nav aria-label=\"Sections\">" + links + "</nav>\n<main>\n" + sections + "</main>\n" +
           footerOf(analysis.data, logHead) + "</body>\n</html>\n";
}

}  // namespace reports
