#include "reports/tables/chain_tables.h"

#include <utility>

#include "reports/analysis/quality_chain.h"
#include "reports/formats/table_cells.h"

namespace reports {
namespace {

/// A number and its interval: in one column of documents, in two of the CSV.
void addColumns(Table& table, const std::string& heading)
{
    table.columns.emplace_back(heading);
    table.columns.emplace_back(heading + ": 95 % CI low", ColumnUse::InCsv);
    table.columns.emplace_back(heading + ": 95 % CI high", ColumnUse::InCsv);
    table.columns.emplace_back("95 % CI", ColumnUse::InDocuments);
}

void addCells(std::vector<TableCell>& row, const stats::Value& value, const stats::Interval& ci95, int decimals)
{
    row.push_back(numberCell(value, decimals));
    row.push_back(numberCell(ci95.low, decimals));
    row.push_back(numberCell(ci95.high, decimals));
    row.push_back(intervalCell(ci95, decimals));
}

Table priceTable(const QualityChain& chain)
{
    Table table{
        "chain_renderings",
        "What each rendering costs and gives up, over the fabrics, measured when the study was made: time of its signals, "
        "error against the accurate rendering and against the measured signal, and difference under a simulated finger",
        {"condition", "quality", "fabrics"},
        {}};
    for (const PriceMeasureRow& measure : priceMeasureRows) addColumns(table, measure.heading);
    for (const ChainRow& row : chain.rows) {
        std::vector<TableCell> cells{conditionCell(row.price.condition), textCell(row.price.quality),
                                     countCell(row.price.fabrics)};
        for (const PriceMeasureRow& measure : priceMeasureRows)
            addCells(cells, row.price[measure.measure].value, row.price[measure.measure].ci95, measure.decimals);
        table.rows.push_back(std::move(cells));
    }
    return table;
}

std::string answerHeading(const ChainQuestion& question)
{
    return question.id + (question.isChoice ? ": share correct" : ": mean rating");
}

/// The chain from one end to the other; what lies between is in priceTable().
Table peopleTable(const QualityChain& chain)
{
    const std::string intervals = answerIntervalsText(chain);
    Table table{"chain",
                "Speed against accuracy, from milliseconds to people: time and error of each rendering, its difference under a "
                "simulated finger, and the participants' answers" +
                    (intervals.empty() ? "" : ". " + intervals),
                {"condition", "quality"},
                {}};
    constexpr PriceMeasure shown[] = {PriceMeasure::Milliseconds, PriceMeasure::ReliefError, PriceMeasure::FrictionError,
                                      PriceMeasure::FeltDifference};
    for (const PriceMeasure measure : shown) table.columns.emplace_back(rowOf(measure).heading);
    for (const ChainQuestion& question : chain.questions) addColumns(table, answerHeading(question));
    table.columns.emplace_back("matches per rendering");
    addColumns(table, "bits per second");
    for (const ChainRow& row : chain.rows) {
        std::vector<TableCell> cells{conditionCell(row.price.condition), textCell(row.price.quality)};
        for (const PriceMeasure measure : shown) cells.push_back(numberCell(row.price[measure].value, rowOf(measure).decimals));
        for (std::size_t q = 0; q < chain.questions.size(); ++q)
            addCells(cells, row.answers[q].value, row.answers[q].ci95, chain.questions[q].isChoice ? 3 : 2);
        cells.push_back(numberCell(row.matchesPerRendering, 2));
        addCells(cells, row.bitsPerSecond, row.bitsPerSecondCi95, 3);
        table.rows.push_back(std::move(cells));
    }
    return table;
}

}  // namespace

std::vector<ReportTable> chainTables(const StudyAnalysis& analysis)
{
    const QualityChain chain = qualityChain(analysis);
    if (chain.rows.empty()) return {};
    std::vector<ReportTable> tables;
    tables.push_back({.table = peopleTable(chain), .section = PageSection::Chain});
    tables.push_back({.table = priceTable(chain),
                      .section = PageSection::Chain,
                      .foldedUnder = "What each rendering costs and gives up, with intervals over fabrics"});
    return tables;
}

}  // namespace reports
