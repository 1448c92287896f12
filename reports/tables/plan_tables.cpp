#include "reports/tables/plan_tables.h"

#include <cctype>

#include "protocols/files/markup_text.h"
#include "reports/formats/table_cells.h"
#include "reports/text/condition_label.h"
#include "reports/text/plain_words.h"
#include "reports/text/tex_text.h"

namespace reports {
namespace {

/// Hyphens before numbers become minus signs, as in "−0.5 and 0.5".
std::string withMinusSigns(const std::string& text)
{
    std::string set;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool beginsWord = i == 0 || text[i - 1] == ' ';
        const bool isBeforeDigit = i + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0;
        set += text[i] == '-' && beginsWord && isBeforeDigit ? "\u2212" : std::string(1, text[i]);
    }
    return set;
}

/// Documents have minus signs; the CSV and the terminal keep hyphens.
TableCell planCell(const std::string& text)
{
    TableCell cell = textCell(text);
    cell.html = protocols::escapedMarkup(withMinusSigns(text));
    cell.tex = escapedTex(withMinusSigns(text));
    return cell;
}

TableCell plannedCell(const PlanComparison& plan, const PlanRow& row)
{
    TableCell cell = planCell(row.planned);
    if (plan.contrasts.empty() || row.planned != contrastName(plan.contrasts.front())) return cell;
    const ContrastDone& primary = plan.contrasts.front();
    cell.html = htmlLabel(primary.a) + " \u2212 " + htmlLabel(primary.b);
    cell.tex = texLabel(primary.a) + " $-$ " + texLabel(primary.b);
    return cell;
}

Table itemsTable(const PlanComparison& plan)
{
    Table table{"plan", "Planned and done", {"item", "planned", "done", "as planned"}, {}};
    for (const PlanRow& row : plan.rows)
        table.rows.push_back({textCell(row.item), plannedCell(plan, row), planCell(row.done), textCell(nameOf(row.accord))});
    return table;
}

Table contrastsDoneTable(const PlanComparison& plan)
{
    Table table{"plan_contrasts",
                "Planned contrasts a \u2212 b, the primary one first",
                {"a", "b", "primary", "tested in", "not tested in", "why not"},
                {}};
    for (const ContrastDone& contrast : plan.contrasts)
        table.rows.push_back({conditionCell(contrast.a), conditionCell(contrast.b), textCell(contrast.primary ? "yes" : ""),
                              textCell(listed(contrast.testedIn)), textCell(listed(contrast.untested)), textCell(contrast.why)});
    return table;
}

}  // namespace

std::vector<ReportTable> planTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    if (!analysis.plan.rows.empty()) tables.push_back({.table = itemsTable(analysis.plan), .section = PageSection::Plan});
    if (!analysis.plan.contrasts.empty())
        tables.push_back(
            {.table = contrastsDoneTable(analysis.plan), .section = PageSection::Plan, .foldedUnder = "Each planned contrast"});
    return tables;
}

}  // namespace reports
