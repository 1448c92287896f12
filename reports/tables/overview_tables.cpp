#include "reports/tables/overview_tables.h"

#include "reports/formats/table_cells.h"
#include "reports/formats/table_formats.h"

namespace reports {
namespace {

void addChoiceColumns(Table& table, const StudyAnalysis& analysis, const AnalysedQuestion<ChoiceAnalysis>& question)
{
    table.columns.emplace_back(question.id() + " matches of " + std::to_string(analysis.data.participants.size()));
    table.columns.emplace_back(question.id() + " correct");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const ConditionChoices& choices = question.findings.conditions[i];
        table.rows[i].push_back(numberCell(choices.matchesPerRendering, 1));
        table.rows[i].push_back(
            numericTextCell(std::to_string(choices.count.correct) + "/" + std::to_string(choices.count.trials)));
    }
}

void addRatingColumns(Table& table, const AnalysedQuestion<RatingAnalysis>& question)
{
    table.columns.emplace_back(questionColumn(question.id()));
    table.columns.emplace_back(question.id() + " sd", ColumnUse::InCsv);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const ConditionRatings& ratings = question.findings.conditions[i];
        table.rows[i].push_back(meanSdCell(ratings.mean, ratings.sd, 1));
        table.rows[i].push_back(numberCell(ratings.sd, 1));
    }
}

void addWordedColumn(Table& table, const AnalysedQuestion<WordedAnalysis>& question)
{
    table.columns.emplace_back(question.id() + " answers");
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        table.rows[i].push_back(countCell(question.findings.conditions[i].answers));
}

Table overviewTable(const StudyAnalysis& analysis)
{
    Table table{"overview", "Matches per rendering, and ratings as mean \u00B1 SD over ratings", {"condition"}, {}};
    for (const std::string& condition : analysis.data.conditions) table.rows.push_back({conditionCell(condition)});
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) addChoiceColumns(table, analysis, question);
    for (const auto& question : questionsWith<RatingAnalysis>(analysis)) addRatingColumns(table, question);
    for (const auto& question : questionsWith<WordedAnalysis>(analysis)) addWordedColumn(table, question);
    return table;
}

}  // namespace

std::vector<ReportTable> overviewTables(const StudyAnalysis& analysis)
{
    return {{.table = overviewTable(analysis), .section = PageSection::Summary}};
}

std::string overviewText(const StudyAnalysis& analysis) { return toText(overviewTable(analysis)); }

}  // namespace reports
