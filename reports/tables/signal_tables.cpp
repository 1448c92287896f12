#include "reports/tables/signal_tables.h"

#include "reports/formats/table_cells.h"

namespace reports {
namespace {

std::string verdictOn(const SignalTest& test)
{
    if (!test.p.exists() || !test.equivalence.p.exists()) return "undefined";
    return std::string(*test.p < 0.05 ? "different" : "difference not shown") +
           (*test.equivalence.p < 0.05 ? " / equivalent" : " / equivalence not shown");
}

stats::Value scaledForTable(const stats::Value& value, double factor)
{
    return value.exists() ? stats::Value(*value * factor) : value;
}

stats::Interval scaledForTable(const stats::Interval& interval, double factor)
{
    return {scaledForTable(interval.low, factor), scaledForTable(interval.high, factor)};
}

std::string sourceNote(const SignalSource& source)
{
    if (!source.whyUnfair.empty()) return "not a fair control: " + source.whyUnfair;
    return source.steps ? "trained with " + std::to_string(*source.steps) + " steps" : std::string();
}

std::vector<TableCell> sourceCells(const SignalSource& source)
{
    std::vector<TableCell> cells{textCell(source.name)};
    for (const SignalMeasureRow& row : signalMeasureRows)
        cells.push_back(numberCell(scaledForTable(source.mean[row.measure], row.factor), row.decimals));
    cells.push_back(textCell(sourceNote(source)));
    return cells;
}

ReportTable controlsTable(const SignalControls& controls)
{
    Table table{"signals_controls", "Generated signals and controls against the measured signals, means over fabrics", {}, {}};
    table.columns.emplace_back("signals");
    for (const SignalMeasureRow& row : signalMeasureRows) table.columns.emplace_back(row.heading);
    table.columns.emplace_back("note");
    table.rows.push_back(sourceCells(controls.generated));
    table.rows.push_back(sourceCells(controls.generatedMean));
    for (const SignalSource& source : controls.controls) table.rows.push_back(sourceCells(source));
    return {.table = std::move(table), .section = PageSection::Signals};
}

ReportTable differencesTable(const SignalControls& controls)
{
    Table table{"signals_differences",
                "Generated signals minus each control, one difference a fabric; Holm's correction over the controls",
                {"control", "measure", "n", "mean difference", "95 % CI", "p", "p (Holm)", "generated is"},
                {}};
    for (const SignalSource& source : controls.controls)
        for (const auto& [measure, difference] : source.differences) {
            const SignalMeasureRow& row = rowOf(measure);
            table.rows.push_back({textCell(source.name), textCell(row.heading), countCell(difference.n),
                                  numberCell(scaledForTable(difference.meanDifference, row.factor), row.decimals),
                                  intervalCell(scaledForTable(difference.ci95, row.factor), row.decimals), pCell(difference.p),
                                  pCell(difference.pHolm), textCell(wordFor(measure, difference))});
        }
    return {.table = std::move(table), .section = PageSection::Signals, .foldedUnder = "Differences from the controls"};
}

}  // namespace

std::vector<ReportTable> signalTables(const StudyAnalysis& analysis)
{
    if (!analysis.data.signals) return {};
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
    std::vector<ReportTable> tables;
    if (const auto& controls = analysis.data.signals->controls) {
        tables.push_back(controlsTable(*controls));
        tables.push_back(differencesTable(*controls));
    }
    tables.push_back({.table = std::move(table), .section = PageSection::Signals});
    return tables;
}

}  // namespace reports
