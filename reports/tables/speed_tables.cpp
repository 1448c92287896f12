#include "reports/tables/speed_tables.h"

#include <cmath>

#include "reports/formats/table_cells.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

Table speedTable(const StudyAnalysis& analysis)
{
    Table table{"speed_accuracy",
                "Speed and accuracy of the matching task by condition; intervals over participants, for these fabrics",
                {"condition",
                 "median s",
                 "bits per second",
                 {"bits per second: 95 % CI low", ColumnUse::InCsv},
                 {"bits per second: 95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "balanced integration score",
                 {"balanced integration score: 95 % CI low", ColumnUse::InCsv},
                 {"balanced integration score: 95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments}},
                {}};
    for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
        const ConditionSpeed& speed = analysis.speed[i];
        table.rows.push_back({conditionCell(analysis.data.conditions[i]), numberCell(speed.medianSeconds, 1),
                              numberCell(speed.bitsPerSecond, 3), numberCell(speed.bitsPerSecondCi95.low, 3),
                              numberCell(speed.bitsPerSecondCi95.high, 3), intervalCell(speed.bitsPerSecondCi95, 3),
                              numberCell(speed.balancedIntegrationScore, 2), numberCell(speed.scoreCi95.low, 2),
                              numberCell(speed.scoreCi95.high, 2), intervalCell(speed.scoreCi95, 2)});
    }
    return table;
}

stats::Value exponentialOf(const stats::Value& value) { return value.exists() ? stats::Value(std::exp(*value)) : value; }

/// A ratio of times from a difference of logarithms.
stats::SpeedDifference asRatio(stats::SpeedDifference difference)
{
    difference.test.estimate = exponentialOf(difference.test.estimate);
    difference.test.ci = {exponentialOf(difference.test.ci.low), exponentialOf(difference.test.ci.high)};
    return difference;
}

Table speedContrastTable(const std::string& id, const SpeedAnalysis& speed)
{
    Table table{"speed_contrasts_" + lowerCase(id),
                id + ": differences of conditions in speed and accuracy, over participants, for these fabrics. Response time: "
                     "ratio a/b. p after Holm's correction over the contrasts of one measure",
                {"a",
                 "b",
                 "measure",
                 "n",
                 "a\u2212b, or a/b",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "df",
                 {"p uncorrected", ColumnUse::InCsv},
                 "p"},
                {}};
    const auto add = [&](const SpeedContrast& contrast, const std::string& measure, const stats::SpeedDifference& difference,
                         int decimals) {
        const stats::TTest& test = difference.test;
        table.rows.push_back({conditionCell(contrast.a), conditionCell(contrast.b), textCell(measure), countCell(test.n),
                              numberCell(test.estimate, decimals), numberCell(test.ci.low, decimals),
                              numberCell(test.ci.high, decimals), intervalCell(test.ci, decimals), numberCell(test.df, 0),
                              pCell(test.p, test.logP), pCell(difference.pHolm)});
    };
    for (const SpeedContrast& contrast : speed.contrasts) {
        add(contrast, "bits per second", contrast.tests.bitsPerSecond, 3);
        add(contrast, "balanced integration score", contrast.tests.score, 2);
        add(contrast, "response time", asRatio(contrast.tests.logSeconds), 2);
    }
    return table;
}

Table accuracyTable(const StudyAnalysis& analysis, const std::string& id, const AccuracyBySpeed& accuracy)
{
    Table table{"conditional_accuracy_" + lowerCase(id),
                id + ": share correct by response time. Bins are equal parts of each participant's own times, from fast to slow; "
                     "intervals over participants, for these fabrics",
                {"condition",
                 "bin",
                 "participants",
                 "choices",
                 "mean s",
                 "share correct",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments}},
                {}};
    const auto add = [&](const TableCell& name, const std::vector<SpeedBin>& bins) {
        for (std::size_t i = 0; i < bins.size(); ++i)
            table.rows.push_back({name, numericTextCell(std::to_string(i + 1) + " of " + std::to_string(bins.size())),
                                  countCell(bins[i].participants), countCell(bins[i].choices), numberCell(bins[i].meanSeconds, 1),
                                  numberCell(bins[i].share, 2), numberCell(bins[i].ci95.low, 2), numberCell(bins[i].ci95.high, 2),
                                  intervalCell(bins[i].ci95, 2)});
    };
    add(textCell("all conditions"), accuracy.bins);
    for (std::size_t c = 0; c < accuracy.conditions.size(); ++c)
        add(conditionCell(analysis.data.conditions[c]), accuracy.conditions[c]);
    return table;
}

Table stampTable(const std::vector<StampCounts>& counts)
{
    Table table{"stamps",
                "Times and entries: who stamped the first touch, how many answers have a response time, and how many second "
                "entries differed from the first",
                {"question", "answers", "with a response time", "touch stamped by the display", "by the operator",
                 "entered twice", "first two entries differed"},
                {}};
    for (const StampCounts& count : counts)
        table.rows.push_back({textCell(count.question), countCell(count.answers), countCell(count.withTime),
                              countCell(count.touchedByDisplay), countCell(count.touchedByOperator),
                              countCell(count.secondEntries), countCell(count.differing)});
    return table;
}

}  // namespace

std::vector<ReportTable> speedTables(const StudyAnalysis& analysis)
{
    const auto choices = questionsWith<ChoiceAnalysis>(analysis);
    std::vector<ReportTable> tables;
    tables.push_back({.table = speedTable(analysis), .section = PageSection::Speed, .onPage = !choices.empty()});
    for (const auto& question : choices) {
        const SpeedAnalysis& speed = question.findings.speed;
        if (!speed.contrasts.empty())
            tables.push_back({.table = speedContrastTable(question.id(), speed),
                              .section = PageSection::Speed,
                              .question = question.id(),
                              .foldedUnder = question.id() + ": speed and accuracy between conditions"});
        if (Table table = accuracyTable(analysis, question.id(), question.findings.accuracyBySpeed); !table.rows.empty())
            tables.push_back({.table = std::move(table),
                              .section = PageSection::Speed,
                              .question = question.id(),
                              .foldedUnder = question.id() + ": share correct by response time"});
    }
    if (analysis.data.times != TimesTaken::AsRecorded)
        tables.push_back({.table = stampTable(stampCountsOf(analysis.data)),
                          .section = PageSection::Speed,
                          .foldedUnder = "Times and entries"});
    return tables;
}

}  // namespace reports
