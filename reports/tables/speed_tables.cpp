#include "reports/tables/speed_tables.h"

#include "reports/tables/table_cells.h"

namespace reports {

std::vector<ReportTable> speedTables(const StudyAnalysis& analysis)
{
    Table table{"speed_accuracy",
                "Speed and accuracy of the matching task by condition",
                {"condition", "median s", "bits per second", "balanced integration score"},
                {}};
    for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
        const ConditionSpeed& speed = analysis.speed[i];
        table.rows.push_back({conditionCell(analysis.data.conditions[i]), numberCell(speed.medianSeconds, 1),
                              numberCell(speed.bitsPerSecond, 3), numberCell(speed.balancedIntegrationScore, 2)});
    }
    return {
        {.table = std::move(table), .section = PageSection::Speed, .onPage = !questionsWith<ChoiceAnalysis>(analysis).empty()}};
}

}  // namespace reports
