#include "reports/tables/touch_tables.h"

#include "reports/formats/table_cells.h"

namespace reports {
namespace {

constexpr const char* whyNoTaps = "no signal was answered";

Table touchTable(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    Table table{"touch",
                "The finger on the display by condition: scanning speed (length of the path through the time in contact) and "
                "normal force. Intervals over participants, for these fabrics",
                {"condition",
                 "measure",
                 "presentations",
                 "participants",
                 "median",
                 "mean of participants",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments}},
                {}};
    for (std::size_t c = 0; c < data.conditions.size(); ++c) {
        const auto add = [&](const char* measure, const TouchQuantity& quantity, int decimals) {
            table.rows.push_back({conditionCell(data.conditions[c]), textCell(measure), countCell(quantity.presentations),
                                  countCell(quantity.participants), numberCell(quantity.median, decimals),
                                  numberCell(quantity.mean, decimals), numberCell(quantity.ci95.low, decimals),
                                  numberCell(quantity.ci95.high, decimals), intervalCell(quantity.ci95, decimals)});
        };
        add("speed, mm/s", analysis.touch[c].speedMmPerS, 1);
        add("force, N", analysis.touch[c].forceN, 2);
        add("time in contact, s", analysis.touch[c].contactSeconds, 1);
    }
    return table;
}

stats::Value millisecondsOf(const std::optional<double>& value)
{
    return value ? stats::Value(*value) : stats::Value::undefined(whyNoTaps);
}

Table latencyTable(const StudyData& data)
{
    Table table{"operator_latency",
                "Latencies of the operators, from a signal to the key. They are part of every time that a key stamps, and are "
                "never subtracted",
                {"operator", "time", "signal", "taps", "misses", "too early", "median ms", "quartile 1 ms", "quartile 3 ms"},
                {}};
    for (const OperatorTaps& run : data.operatorTaps)
        table.rows.push_back({textCell(run.operatorName), textCell(run.wallTime), textCell(run.signal),
                              countCell(static_cast<std::size_t>(run.taps)), countCell(static_cast<std::size_t>(run.misses)),
                              countCell(static_cast<std::size_t>(run.anticipations)), numberCell(millisecondsOf(run.medianMs), 0),
                              numberCell(millisecondsOf(run.q1Ms), 0), numberCell(millisecondsOf(run.q3Ms), 0)});
    return table;
}

}  // namespace

std::vector<ReportTable> touchTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    if (!analysis.touch.empty()) tables.push_back({.table = touchTable(analysis), .section = PageSection::Speed});
    if (!analysis.data.operatorTaps.empty())
        tables.push_back({.table = latencyTable(analysis.data), .section = PageSection::Speed});
    return tables;
}

}  // namespace reports
