#include "reports/page/page.h"

#include <algorithm>

#include "reports/analysis/quality_flags.h"
#include "reports/tables/report_tables.h"

namespace reports {
namespace {

class Page {
public:
    Page(const Analysis& analysis, const std::vector<Figure>& figures)
        : m_analysis(analysis), m_data(analysis.data), m_results(analysis.results), m_figures(figures)
    {
    }

    std::string written()
    {
        addSummary();
        addMatches();
        addRatings();
        addComparisons();
        addEquivalence();
        addSpeed();
        addSignals();
        addQuality();
        addMethods();
        return head() + m_body + tail();
    }

private:
    std::string tags() const
    {
        std::string html;
        if (m_data.simulated) html += "<span class=\"tag simulated\">SIMULATED participants</span>";
        if (m_data.scripted) html += "<span class=\"tag simulated\">SCRIPTED participants</span>";
        if (m_data.blinded) html += "<span class=\"tag blinded\">blinded</span>";
        return html;
    }

    std::string notices() const
    {
        std::string html;
        if (m_data.simulated)
            html +=
                "<p class=\"notice\"><b>SIMULATED participants.</b> No person took part; the numbers show what the program does, "
                "not how a rendering feels.</p>\n";
        if (m_data.scripted)
            html += "<p class=\"notice\"><b>SCRIPTED participants.</b> The answers were written into a file beforehand.</p>\n";
        if (m_data.blinded)
            html +=
                "<p class=\"notice plain\"><b>This report is blinded.</b> Conditions carry masked labels; signals, groups and "
                "planned contrasts are left out until the study is unblinded.</p>\n";
        for (const std::string& stamp : m_data.stamps) html += "<p class=\"notice plain\">" + escapedHtml(stamp) + "</p>\n";
        return html;
    }

    std::string head() const
    {
        std::string html =
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
            "content=\"width=device-width, initial-scale=1\">\n<title>" +
            escapedHtml(m_data.name) + " \u2013 report</title>\n<style>" + pageStyle() + "</style>\n</head>\n<body>\n" +
            "<header class=\"top\"><h1>" + escapedHtml(m_data.name) +
            "</h1>\n<p class=\"lede\">Haptic rendering study: " + counted(m_data.participants.size(), "participant") + ", " +
            counted(m_data.fabrics.size(), "fabric") + ", " + counted(m_data.conditions.size(), "condition") + "</p>\n" +
            notices() + "</header>\n<nav aria-label=\"Sections\">";
        for (const auto& [id, title] : m_sections) html += "<a href=\"#" + id + "\">" + title + "</a> ";
        return html + "</nav>\n<main>\n";
    }

    std::string tail() const
    {
        const std::string hash =
            m_data.protocolSha256.empty() ? "" : " Protocol SHA-256: <code>" + escapedHtml(m_data.protocolSha256) + "</code>.";
        return "</main>\n<footer>Numbers in full: <code>results.json</code>, <code>statistics.json</code>, <code>tables/</code>, "
               "<code>figures/</code> beside this page." +
               hash + "</footer>\n</body>\n</html>\n";
    }

    void begin(const std::string& id, const std::string& title)
    {
        m_sections.emplace_back(id, title);
        m_body += "<section id=\"" + id + "\" aria-labelledby=\"" + id + "-h\"><div class=\"head\"><h2 id=\"" + id + "-h\">" +
                  title + "</h2>" + tags() + "</div>\n";
    }
    void end() { m_body += "</section>\n"; }
    void paragraph(const std::string& html) { m_body += "<p>" + html + "</p>\n"; }

    void figure(const std::string& name)
    {
        for (const Figure& one : m_figures)
            if (one.name == name)
                m_body += "<figure>" + one.svg + "<figcaption>" + escapedHtml(one.caption) + "</figcaption></figure>\n";
    }

    void details(const std::string& summary, const std::string& html)
    {
        m_body += "<details><summary>" + escapedHtml(summary) + "</summary>" + html + "</details>\n";
    }

    void tile(const std::string& value, const std::string& what)
    {
        m_body += "<div class=\"tile\"><b>" + value + "</b><span>" + what + "</span></div>";
    }

    void addSummary()
    {
        const Json& data = m_analysis.statistics["data"];
        begin("summary", "Summary");
        m_body += "<div class=\"tiles\">";
        tile(std::to_string(m_data.participants.size()), "participants");
        tile(std::to_string(m_data.conditions.size() * m_data.fabrics.size()), "renderings");
        tile(std::to_string(data.value("responses", std::size_t{0})), "answers analysed");
        tile(std::to_string(data.value("missing_responses", std::size_t{0})), "answers missing");
        tile(std::to_string(m_data.voided), "presentations voided");
        tile(std::to_string(m_results["quality"].size()), "quality flags");
        m_body += "</div>\n<ul class=\"findings\">";
        for (const std::string& sentence : findings(m_analysis)) m_body += "<li>" + sentence + "</li>\n";
        m_body += "</ul>\n" + toHtml(overviewTable(m_results));
        end();
    }

    std::string wordsOf(const std::string& question) const
    {
        for (const QuestionInfo& info : m_data.questions)
            if (info.id == question && !info.text.empty())
                return "<b>" + escapedHtml(question) + "</b> \u201C" + escapedHtml(info.text) + "\u201D";
        return {};
    }

    void addMatches()
    {
        const auto questions = choiceQuestions(m_results);
        if (questions.empty()) return;
        begin("matches", "Matching the fabric");
        for (const std::string& question : questions) {
            if (const std::string words = wordsOf(question); !words.empty()) paragraph(words);
            figure("matches_" + question);
            m_body += toHtml(matchesTable(m_analysis, question));
            details("Matches by fabric", toHtml(matchesByFabricTable(m_analysis, question)));
        }
        end();
    }

    void addRatings()
    {
        const auto questions = ratingQuestions(m_results);
        if (questions.empty()) return;
        begin("ratings", "Ratings");
        std::string words;
        for (const std::string& question : questions)
            words += (words.empty() || wordsOf(question).empty() ? "" : "<br>") + wordsOf(question);
        if (!words.empty()) paragraph(words);
        figure("ratings");
        for (const std::string& question : questions) m_body += toHtml(ratingsTable(m_analysis, question));
        end();
    }

    void addComparisons()
    {
        begin("comparisons", "Are conditions different?");
        paragraph("Paired t tests of the participants' means; a small p shows a difference, a large one shows nothing.");
        if (hasPlanned(m_results)) m_body += toHtml(plannedComparisonsTable(m_results));
        m_body += toHtml(omnibusTable(m_analysis));
        for (const QuestionInfo& question : m_data.questions)
            details(question.id + ": all pairs", toHtml(comparisonsTable(m_results, question.id)));
        end();
    }

    void addEquivalence()
    {
        const auto questions = ratingQuestions(m_results);
        if (questions.empty()) return;
        begin("equivalence", "Are conditions alike?");
        paragraph("Two one-sided tests against the stated bounds; equivalent when the 90 % interval lies inside them.");
        if (hasPlanned(m_results)) m_body += toHtml(plannedEquivalenceTable(m_results));
        for (const std::string& question : questions)
            details(question + ": all pairs", toHtml(equivalenceTable(m_results, question)));
        end();
    }

    void addSpeed()
    {
        if (choiceQuestions(m_results).empty()) return;
        begin("speed", "Speed and accuracy");
        m_body += toHtml(speedTable(m_analysis));
        end();
    }

    void addSignals()
    {
        const Json& signals = m_results["signals"];
        if (!signals.is_object()) return;
        begin("signals", "Generated against measured signals");
        m_body += "<div class=\"tiles\">";
        const auto show = [&](const char* key, int decimals, double factor, const std::string& unit, const std::string& what) {
            const stats::Value value = valueOf(signals, key);
            tile(value.exists() ? fixed(*value * factor, decimals) + unit : "\u2013",
                 what + (value.exists() ? "" : ": " + escapedHtml(value.why())));
        };
        show("friction_mae", 4, 1, "", "mean absolute error of the friction coefficient");
        show("friction_mae_over_mean", 1, 100, " %", "of the mean measured friction");
        show("height_ssim", 3, 1, "", "structural similarity (SSIM) of the height maps");
        show("height_range_mm", 3, 1, " mm", "range of the measured maps (L of SSIM)");
        m_body += "</div>\n";
        paragraph(
            "The t test asks whether the averages differ, and a small p would show that they do. That generated and measured "
            "averages are close is the claim of the equivalence test beside it.");
        m_body += toHtml(signalsTable(signals));
        end();
    }

    void addQuality()
    {
        begin("quality", "Data quality");
        const Json& data = m_analysis.statistics["data"];
        paragraph(std::to_string(data.value("responses", std::size_t{0})) + " of " +
                  std::to_string(data.value("expected_responses", std::size_t{0})) + " expected answers are analysed; " +
                  std::to_string(data.value("missing_responses", std::size_t{0})) + " are missing; " +
                  counted(m_data.voided, "presentation") + " voided.");
        if (m_results["quality"].empty())
            paragraph("Nothing is flagged.");
        else
            m_body += toHtml(qualityTable(m_results));
        if (const Table screening = screeningTable(m_analysis); !screening.rows.empty())
            details("Means without flagged participants", toHtml(screening));
        details("Missing answers by condition", toHtml(missingTable(m_analysis)));
        std::string rules = "<ul>";
        for (const std::string& sentence : ruleSentences()) rules += "<li>" + escapedHtml(sentence) + "</li>";
        details("What is flagged", rules + "</ul>");
        end();
    }

    void addMethods()
    {
        begin("methods", "Methods");
        for (const std::string& text : methodParagraphs(m_analysis)) paragraph(text);
        m_body += toHtml(measuredSizesTable());
        end();
    }

    const Analysis& m_analysis;
    const StudyData& m_data;
    const Json& m_results;
    const std::vector<Figure>& m_figures;
    std::string m_body;
    std::vector<std::pair<std::string, std::string>> m_sections;
};

}  // namespace

std::string page(const Analysis& analysis, const std::vector<Figure>& figures) { return Page(analysis, figures).written(); }

}  // namespace reports
