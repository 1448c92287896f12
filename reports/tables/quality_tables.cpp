#include "reports/tables/quality_tables.h"

#include "reports/formats/table_cells.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

Table flagsTable(const StudyAnalysis& analysis)
{
    Table table{"quality", "Flags on the data", {"participant", "flag", "why"}, {}};
    for (const QualityFlag& flag : analysis.flags)
        table.rows.push_back({textCell(flag.participant.value_or("all")), textCell(nameOf(flag.kind)), textCell(flag.why)});
    return table;
}

TableCell differenceCell(const ScreenedMean& mean)
{
    return mean.before.exists() && mean.after.exists() ? numberCell(*mean.after - *mean.before, 2) : blankCell();
}

Table screeningTable(const StudyAnalysis& analysis)
{
    std::vector<std::string> names;
    for (const ExcludedParticipant& one : analysis.screening.excluded) names.push_back(one.participant);
    Table table{"screening",
                "Means of the participants' means: before, with all participants; after, without the flagged ones (" +
                    listed(names) + "). Every other table has all participants",
                {"question", "condition", "before", "after", "difference"},
                {}};
    for (const ScreenedQuestion& question : analysis.screening.questions)
        for (std::size_t i = 0; i < question.conditions.size(); ++i) {
            const ScreenedMean& mean = question.conditions[i];
            table.rows.push_back({textCell(question.question), conditionCell(analysis.data.conditions[i]),
                                  numberCell(mean.before, 2), numberCell(mean.after, 2), differenceCell(mean)});
        }
    return table;
}

/// "6 participants analysed", as the table of missing answers counts them.
std::string analysedParticipants(const StudyData& data)
{
    const std::size_t silent = data.participants.size() - answeringParticipants(data);
    return counted(data.participants.size(), "participant") + " analysed" +
           (silent > 0 ? " (" + std::to_string(silent) + " of them without an answer)" : "");
}

Table missingTable(const StudyAnalysis& analysis)
{
    Table table{"missing", "Missing answers by condition, of the " + analysedParticipants(analysis.data), {"condition"}, {}};
    for (const QuestionAnalysis& question : analysis.questions) table.columns.emplace_back(questionColumn(question.question.id));
    for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
        std::vector<TableCell> row{conditionCell(analysis.data.conditions[i])};
        for (const QuestionAnalysis& question : analysis.questions) row.push_back(countCell(question.missing[i]));
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace

std::vector<ReportTable> qualityTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    tables.push_back({.table = flagsTable(analysis), .section = PageSection::Quality, .onPage = !analysis.flags.empty()});
    if (Table screening = screeningTable(analysis); !screening.rows.empty())
        tables.push_back({.table = std::move(screening),
                          .section = PageSection::Quality,
                          .foldedUnder = "Means without flagged participants"});
    if (analysis.data.blinded) return tables;
    tables.push_back(
        {.table = missingTable(analysis), .section = PageSection::Quality, .foldedUnder = "Missing answers by condition"});
    return tables;
}

}  // namespace reports
