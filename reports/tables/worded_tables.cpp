#include "reports/tables/worded_tables.h"

#include "reports/formats/table_cells.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// A longer table is folded, because it would push the rest of the page out of sight.
constexpr std::size_t longestOpenTable = 40;

Table wordedTable(const std::vector<AnalysedQuestion<WordedAnalysis>>& questions)
{
    Table table{"worded_answers",
                "Every answer in words, as it was entered",
                {"participant", "fabric", "condition", "question", "words"},
                {}};
    for (const auto& question : questions)
        for (const SpokenWords& answer : question.findings.answers)
            table.rows.push_back({textCell(answer.participant), textCell(answer.fabric), conditionCell(answer.condition),
                                  textCell(question.id()), textCell(answer.words)});
    return table;
}

}  // namespace

std::vector<ReportTable> wordedTables(const StudyAnalysis& analysis)
{
    const auto questions = questionsWith<WordedAnalysis>(analysis);
    if (questions.empty()) return {};
    const Table table = wordedTable(questions);
    const std::size_t n = table.rows.size();
    return {{.table = table,
             .section = PageSection::Words,
             .foldedUnder = n > longestOpenTable ? "All " + counted(n, "answer") : std::string()}};
}

}  // namespace reports
