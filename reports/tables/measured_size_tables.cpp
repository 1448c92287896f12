#include "reports/tables/measured_size_tables.h"

#include "reports/formats/table_cells.h"
#include "stats/power/measured_size.h"

namespace reports {

std::vector<ReportTable> measuredSizeTables(const StudyAnalysis&)
{
    Table table{"measured_sizes",
                "How often each test rejected at 5 % in " + std::to_string(stats::measuredStudies) +
                    " simulated studies of the paper's size without a true effect",
                {"test", "what was simulated", "rejected %", "attainable %", "remark"},
                {}};
    for (const stats::MeasuredSize& size : stats::measuredSizes()) {
        const bool isExact = size.attainableSize > 0;
        table.rows.push_back(
            {textCell(std::string(size.test)), textCell(std::string(size.truth)),
             numberCell(static_cast<double>(size.rejected) * 100 / static_cast<double>(stats::measuredStudies), 2),
             isExact ? numberCell(100 * size.attainableSize, 2) : blankCell(),
             size.antiConservative() ? textCell("anti-conservative") : blankCell()});
    }
    return {
        {.table = std::move(table), .section = PageSection::Methods, .foldedUnder = "Measured error rates of the other tests"}};
}

}  // namespace reports
