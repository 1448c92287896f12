#include "reports/tables/overview_tables.h"

#include "reports/formats/table_cells.h"
#include "reports/formats/table_formats.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

void addChoiceColumns(Table& table, const StudyAnalysis& analysis, const AnalysedQuestion<ChoiceAnalysis>& question)
{
    const std::size_t people = answeringParticipants(analysis.data, question.findings);
    table.columns.emplace_back(question.id() + " matches of " + std::to_string(people));
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

/// "Q1 share right" or "Q2 mean".
std::string meanColumn(const BlindedQuestion& question)
{
    return question.question.id + (question.isChosen() ? " share right" : " mean");
}

/// Rounded means under K-labels.
Table blindedTable(const StudyAnalysis& analysis)
{
    const BlindedMeans& means = analysis.blindedMeans;
    Table table{"overview",
                "Rounded means of the " + counted(means.participants, "participant") + ", who have all finished",
                {"condition"},
                {}};
    for (const std::string& condition : analysis.data.conditions) table.rows.push_back({conditionCell(condition)});
    for (const BlindedQuestion& question : means.questions) {
        table.columns.emplace_back(question.question.id + " n");
        if (question.step > 0) table.columns.emplace_back(meanColumn(question));
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            const BlindedMean& mean = question.conditions[i];
            table.rows[i].push_back(countCell(mean.n));
            if (question.step > 0) table.rows[i].push_back(numberCell(mean.mean, question.decimals()));
        }
    }
    return table;
}

}  // namespace

std::vector<ReportTable> overviewTables(const StudyAnalysis& analysis)
{
    if (!analysis.data.blinded) return {{.table = overviewTable(analysis), .section = PageSection::Summary}};
    if (!analysis.blindedMeans.why.empty()) return {};
    return {{.table = blindedTable(analysis), .section = PageSection::Summary}};
}

std::string overviewText(const StudyAnalysis& analysis)
{
    if (!analysis.data.blinded) return toText(overviewTable(analysis));
    const std::string& why = analysis.blindedMeans.why;
    return (why.empty() ? toText(blindedTable(analysis)) : why + "\n") + restAfterUnblinding + "\n";
}

}  // namespace reports
