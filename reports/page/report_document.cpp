#include "reports/page/report_document.h"

#include <algorithm>
#include <string_view>

#include "protocols/files/markup_text.h"
#include "reports/page/section_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// Further remarks stand in the section on data quality, so that the first page holds results. Grave ones stand above all the
/// same.
constexpr std::size_t mostStampsAbove = 2;

/// Words of remarks that put results or the blinding in doubt.
constexpr std::string_view graveWords[] = {
    "After the unblinding came",  "give the same image", "felt no image",  "does not look like cloth",
    "among the training samples", "no passphrase",       "as plain files", "are damaged",
    "used another display"};

bool isGrave(const std::string& remark)
{
    return std::ranges::any_of(graveWords, [&](std::string_view words) { return remark.find(words) != std::string::npos; });
}

/// Grave remarks come first; otherwise the order is kept. Remarks that stand at the head of the report.
std::vector<std::string> remarksAbove(std::vector<std::string> remarks)
{
    const auto others = std::ranges::stable_partition(remarks, isGrave);
    const std::size_t grave = remarks.size() - others.size();
    remarks.resize(std::min(remarks.size(), std::max(mostStampsAbove, grave)));
    return remarks;
}

std::vector<DocumentTag> tagsOf(const StudyData& data)
{
    std::vector<DocumentTag> tags;
    if (data.simulated) tags.push_back({"SIMULATED participants", true});
    if (data.scripted) tags.push_back({"SCRIPTED participants", true});
    if (data.blinded) tags.push_back({"blinded", false});
    return tags;
}

std::vector<DocumentNotice> noticesOf(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    std::vector<DocumentNotice> notices;
    if (data.simulated)
        notices.push_back(
            {"<b>SIMULATED participants.</b> No person took part. The numbers show what the program does, not how a rendering "
             "feels.",
             true});
    if (data.scripted)
        notices.push_back({"<b>SCRIPTED participants.</b> The answers were written into a file beforehand.", true});
    if (data.blinded)
        notices.push_back(
            {"<b>This report is blinded.</b> Conditions carry masked labels. " +
             (analysis.blindedMeans.why.empty() ? "It shows rounded means of the participants, who have all finished."
                                                : protocols::escapedMarkup(analysis.blindedMeans.why)) +
             " " + restAfterUnblinding});
    const std::vector<std::string> above = remarksAbove(data.stamps);
    for (const std::string& remark : above) notices.push_back({protocols::escapedMarkup(remark)});
    if (data.stamps.size() > above.size())
        notices.push_back({counted(data.stamps.size() - above.size(), "more remark") +
                           " on this study: see <a href=\"#quality\">Data quality</a>."});
    for (const std::string& limit : analysis.designLimits) notices.push_back({protocols::escapedMarkup(limit)});
    return notices;
}

std::string footerOf(const StudyData& data, const std::string& logHead)
{
    const std::string head =
        logHead.empty() ? "" : " Head of the study's log: <code>" + protocols::escapedMarkup(logHead) + "</code>.";
    std::vector<std::string> hashes;
    for (const FollowedVersion& one : data.protocolVersions)
        hashes.push_back("version " + std::to_string(one.version) + " <code>" + protocols::escapedMarkup(one.sha256) + "</code>");
    if (hashes.empty()) hashes.push_back("<code>" + protocols::escapedMarkup(data.protocolSha256) + "</code>");
    const std::string hash = data.protocolSha256.empty() ? "" : " Protocol SHA-256: " + listed(hashes) + ".";
    const std::string files =
        data.blinded ? "The same numbers are in <code>results.json</code> and <code>tables/</code> beside this page."
                     : "All numbers with full digits are in <code>results.json</code>, <code>statistics.json</code>, "
                       "<code>tables/</code> and <code>figures/</code> beside this page.";
    return files + hash + head;
}

void addItems(DocumentSection& section, const std::string& question, const std::vector<ReportTable>& tables,
              const std::vector<Figure>& figures)
{
    for (const Figure& figure : figures)
        if (figure.section == section.heading.section && figure.question == question) section.items.emplace_back(&figure);
    for (const ReportTable& one : tables)
        if (one.section == section.heading.section && one.question == question && one.onPage) section.items.emplace_back(&one);
}

}  // namespace

ReportDocument reportDocument(const StudyAnalysis& analysis, const std::vector<ReportTable>& tables,
                              const std::vector<Figure>& figures, const std::string& logHead)
{
    const StudyData& data = analysis.data;
    ReportDocument document;
    document.title = data.name;
    document.lede = "Haptic rendering study: " + counted(answeringParticipants(data), "participant") + ", " +
                    counted(data.fabrics.size(), "fabric") + ", " + counted(data.conditions.size(), "condition");
    document.tags = tagsOf(data);
    document.notices = noticesOf(analysis);
    document.footerHtml = footerOf(data, logHead);
    for (const SectionHeading& heading : sectionHeadings()) {
        DocumentSection section{heading, {}, {}, {}};
        addItems(section, "", tables, figures);
        for (const QuestionAnalysis& question : analysis.questions) addItems(section, question.question.id, tables, figures);
        if (section.items.empty() && !standsAlone(heading.section)) continue;
        section.leadHtml = sectionLead(heading.section, analysis);
        section.endHtml = sectionEnd(heading.section, analysis);
        if (section.items.empty() && section.leadHtml.empty() && section.endHtml.empty()) continue;
        document.sections.push_back(std::move(section));
    }
    return document;
}

}  // namespace reports
