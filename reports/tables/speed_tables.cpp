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
                 {"median s: 95 % CI low", ColumnUse::InCsv},
                 {"median s: 95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
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
                              numberCell(speed.medianSecondsCi95.low, 1), numberCell(speed.medianSecondsCi95.high, 1),
                              intervalCell(speed.medianSecondsCi95, 1), numberCell(speed.bitsPerSecond, 3),
                              numberCell(speed.bitsPerSecondCi95.low, 3), numberCell(speed.bitsPerSecondCi95.high, 3),
                              intervalCell(speed.bitsPerSecondCi95, 3), numberCell(speed.balancedIntegrationScore, 2),
                              numberCell(speed.scoreCi95.low, 2), numberCell(speed.scoreCi95.high, 2),
                              intervalCell(speed.scoreCi95, 2)});
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

std::vector<TableColumn> speedContrastColumns()
{
    return {"a",
            "b",
            "measure",
            "n",
            "a\u2212b, or a/b",
            {"95 % CI low", ColumnUse::InCsv},
            {"95 % CI high", ColumnUse::InCsv},
            {"95 % CI", ColumnUse::InDocuments},
            "df",
            {"p uncorrected", ColumnUse::InCsv},
            "p"};
}

Table speedContrastTable(const std::string& id, const SpeedAnalysis& speed)
{
    Table table{"speed_contrasts_" + lowerCase(id),
                id + ": differences of conditions in speed and accuracy, over participants, for these fabrics. Response time: "
                     "ratio a/b. p after Holm's correction over the contrasts of one measure",
                speedContrastColumns(),
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

constexpr const char* lowOfShare = "share correct: 95 % CI low";

/// The columns of speed and accuracy, with their intervals.
void addSpeedColumns(std::vector<TableColumn>& columns)
{
    const std::vector<TableColumn> more{"share correct",
                                        {lowOfShare, ColumnUse::InCsv},
                                        {"share correct: 95 % CI high", ColumnUse::InCsv},
                                        {"95 % CI", ColumnUse::InDocuments},
                                        "median s",
                                        {"median s: 95 % CI low", ColumnUse::InCsv},
                                        {"median s: 95 % CI high", ColumnUse::InCsv},
                                        {"95 % CI", ColumnUse::InDocuments},
                                        "bits per second",
                                        {"bits per second: 95 % CI low", ColumnUse::InCsv},
                                        {"bits per second: 95 % CI high", ColumnUse::InCsv},
                                        {"95 % CI", ColumnUse::InDocuments},
                                        "balanced integration score",
                                        {"balanced integration score: 95 % CI low", ColumnUse::InCsv},
                                        {"balanced integration score: 95 % CI high", ColumnUse::InCsv},
                                        {"95 % CI", ColumnUse::InDocuments}};
    columns.insert(columns.end(), more.begin(), more.end());
}

void addMeasure(std::vector<TableCell>& row, const stats::Value& value, const stats::Interval& ci, int decimals)
{
    row.insert(row.end(), {numberCell(value, decimals), numberCell(ci.low, decimals), numberCell(ci.high, decimals),
                           intervalCell(ci, decimals)});
}

void addSpeedCells(std::vector<TableCell>& row, const ConditionSpeed& speed)
{
    addMeasure(row, speed.share, speed.shareCi95, 2);
    addMeasure(row, speed.medianSeconds, speed.medianSecondsCi95, 1);
    addMeasure(row, speed.bitsPerSecond, speed.bitsPerSecondCi95, 3);
    addMeasure(row, speed.balancedIntegrationScore, speed.scoreCi95, 2);
}

/// "3 of 63", or nothing without a deadline.
TableCell lateCell(const InstructedSpeed& under)
{
    if (!under.instruction.deadlineSeconds) return blankCell();
    return numericTextCell(std::to_string(under.late) + " of " + std::to_string(under.timed));
}

TableCell deadlineCell(const InstructedSpeed& under)
{
    if (!under.instruction.deadlineSeconds) return blankCell();
    return numberCell(*under.instruction.deadlineSeconds, 1);
}

Table instructionTable(const std::string& id, const InstructionAnalysis& analysis)
{
    Table table{
        "instructions_" + lowerCase(id),
        id + ": speed and accuracy by instruction, all conditions together; intervals over participants, for these fabrics",
        {"instruction", "deadline s", "answers", "late"},
        {}};
    addSpeedColumns(table.columns);
    for (const InstructedSpeed& under : analysis.instructions) {
        std::vector<TableCell> row{textCell(under.instruction.id), deadlineCell(under), countCell(under.answers),
                                   lateCell(under)};
        addSpeedCells(row, under.speed);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table instructedConditionTable(const std::string& id, const InstructionAnalysis& analysis,
                               const std::vector<std::string>& conditions)
{
    Table table{"instructions_by_condition_" + lowerCase(id),
                id + ": speed and accuracy by condition and instruction; intervals over participants, for these fabrics",
                {"condition", "instruction"},
                {}};
    addSpeedColumns(table.columns);
    for (std::size_t c = 0; c < conditions.size(); ++c)
        for (const InstructedSpeed& under : analysis.instructions) {
            std::vector<TableCell> row{conditionCell(conditions[c]), textCell(under.instruction.id)};
            addSpeedCells(row, under.conditions[c]);
            table.rows.push_back(std::move(row));
        }
    return table;
}

Table instructionContrastTable(const std::string& id, const InstructionAnalysis& analysis)
{
    Table table{"instruction_contrasts_" + lowerCase(id),
                id +
                    ": differences between instructions, over participants, for these fabrics. Response time: ratio a/b. p after "
                    "Holm's correction over the contrasts of one measure",
                speedContrastColumns(),
                {}};
    const auto add = [&](const InstructionContrast& contrast, const char* measure, const stats::SpeedDifference& difference,
                         const stats::Value& estimate, const stats::Interval& ci, int decimals) {
        const stats::TTest& test = difference.test;
        table.rows.push_back({textCell(contrast.a), textCell(contrast.b), textCell(measure), countCell(test.n),
                              numberCell(estimate, decimals), numberCell(ci.low, decimals), numberCell(ci.high, decimals),
                              intervalCell(ci, decimals), numberCell(test.df, 0), pCell(test.p, test.logP),
                              pCell(difference.pHolm)});
    };
    for (const InstructionContrast& contrast : analysis.contrasts) {
        const auto plain = [&](const char* measure, const stats::SpeedDifference& difference, int decimals) {
            add(contrast, measure, difference, difference.test.estimate, difference.test.ci, decimals);
        };
        plain("share correct", contrast.share, 2);
        plain("bits per second", contrast.tests.bitsPerSecond, 3);
        plain("balanced integration score", contrast.tests.score, 2);
        const stats::TTest& times = contrast.tests.logSeconds.test;
        add(contrast, "response time", contrast.tests.logSeconds, exponentialOf(times.estimate),
            {exponentialOf(times.ci.low), exponentialOf(times.ci.high)}, 2);
    }
    return table;
}

Table factorTable(const std::string& id, const InstructionAnalysis& analysis)
{
    Table table{"instruction_factors_" + lowerCase(id),
                id + ": analysis of variance within participants with the factors condition and instruction; p after Greenhouse "
                     "and Geisser's correction",
                {"measure", "effect", "participants", "F", "df1", "df2", "p", "partial eta squared"},
                {}};
    const auto add = [&](const char* measure, const stats::TwoWayAnova& anova) {
        if (!anova.why.empty()) return;
        for (const stats::AnovaEffect& effect : anova.effects)
            table.rows.push_back({textCell(measure), textCell(effect.name), countCell(anova.participants),
                                  numberCell(effect.f, 2), numberCell(effect.df1, 0), numberCell(effect.df2, 0),
                                  pCell(effect.pGg, effect.logPGg), numberCell(effect.partialEtaSquared, 2)});
    };
    add("share correct", analysis.shares);
    add("logarithm of the response time", analysis.logSeconds);
    return table;
}

Table instructedAccuracyTable(const std::string& id, const InstructionAnalysis& analysis)
{
    Table table{"instruction_accuracy_" + lowerCase(id),
                id + ": share correct by response time under each instruction. Bins are quarters of each participant's own times "
                     "under the instruction, from fast to slow; intervals over participants, for these fabrics",
                {"instruction",
                 "bin",
                 "participants",
                 "choices",
                 "mean s",
                 "share correct",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments}},
                {}};
    for (const InstructedSpeed& under : analysis.instructions)
        for (std::size_t i = 0; i < under.accuracy.bins.size(); ++i) {
            const SpeedBin& bin = under.accuracy.bins[i];
            table.rows.push_back({textCell(under.instruction.id),
                                  numericTextCell(std::to_string(i + 1) + " of " + std::to_string(under.accuracy.bins.size())),
                                  countCell(bin.participants), countCell(bin.choices), numberCell(bin.meanSeconds, 1),
                                  numberCell(bin.share, 2), numberCell(bin.ci95.low, 2), numberCell(bin.ci95.high, 2),
                                  intervalCell(bin.ci95, 2)});
        }
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

/// None where no block instructs the participant.
void addInstructionTables(std::vector<ReportTable>& tables, const AnalysedQuestion<ChoiceAnalysis>& question,
                          const std::vector<std::string>& conditions)
{
    const InstructionAnalysis& instructions = question.findings.instructions;
    if (instructions.instructions.empty()) return;
    const auto add = [&](Table table, const std::string& heading) {
        if (table.rows.empty()) return;
        tables.push_back({.table = std::move(table),
                          .section = PageSection::Speed,
                          .question = question.id(),
                          .foldedUnder = heading.empty() ? "" : question.id() + ": " + heading});
    };
    add(instructionTable(question.id(), instructions), "");
    add(instructionContrastTable(question.id(), instructions), "differences between instructions");
    add(factorTable(question.id(), instructions), "condition and instruction as factors");
    add(instructedConditionTable(question.id(), instructions, conditions), "by condition and instruction");
    add(instructedAccuracyTable(question.id(), instructions), "share correct by response time under each instruction");
}

}  // namespace

std::vector<ReportTable> speedTables(const StudyAnalysis& analysis)
{
    const auto choices = questionsWith<ChoiceAnalysis>(analysis);
    std::vector<ReportTable> tables;
    tables.push_back({.table = speedTable(analysis), .section = PageSection::Speed, .onPage = !choices.empty()});
    for (const auto& question : choices) {
        addInstructionTables(tables, question, analysis.data.conditions);
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
