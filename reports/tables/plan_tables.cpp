#include "reports/tables/plan_tables.h"

#include "reports/formats/table_cells.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

Table itemsTable(const PlanComparison& plan)
{
    Table table{"plan", "Planned and done", {"item", "planned", "done", "as planned"}, {}};
    for (const PlanRow& row : plan.rows)
        table.rows.push_back({textCell(row.item), textCell(row.planned), textCell(row.done), textCell(nameOf(row.accord))});
    return table;
}

Table contrastsDoneTable(const PlanComparison& plan)
{
    Table table{"plan_contrasts",
                "Planned contrasts a - b, the primary one first",
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
