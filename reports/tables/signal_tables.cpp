#include "reports/tables/signal_tables.h"

#include "reports/tables/table_cells.h"

namespace reports {
namespace {

std::string verdictOn(const SignalTest& test)
{
    if (!test.p.exists() || !test.equivalence.p.exists()) return "undefined";
    return std::string(*test.p < 0.05 ? "different" : "not different") +
           (*test.equivalence.p < 0.05 ? " / equivalent" : " / not shown equivalent");
}

}  // namespace

std::vector<ReportTable> signalTables(const StudyAnalysis& analysis)
{
    if (analysis.data.blinded || !analysis.data.signals) return {};
    Table table{"signals_t_tests",
                "Generated minus measured signals, one mean difference a fabric",
                {"signal",
                 {"unit", ColumnUse::InCsv},
                 "n",
                 "mean difference",
                 "95 % CI",
                 "t",
                 "df",
                 "p (difference)",
                 "bounds",
                 "p (TOST)",
                 "verdict"},
                {}};
    for (const SignalTest& test : analysis.data.signals->tests)
        table.rows.push_back({textCell(test.signal), textCell(test.unit), countCell(test.n), numberCell(test.meanDifference, 4),
                              intervalCell(test.ci95, 4), numberCell(test.statistic, 2), numberCell(test.df, 0), pCell(test.p),
                              intervalCell(test.equivalence.bounds, 4), pCell(test.equivalence.p), textCell(verdictOn(test))});
    return {{.table = std::move(table), .section = PageSection::Signals}};
}

}  // namespace reports
