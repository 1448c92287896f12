#include "reports/tables/choice_tables.h"

#include "reports/formats/table_cells.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using ChoiceQuestion = AnalysedQuestion<ChoiceAnalysis>;

Table matchesTable(const StudyAnalysis& analysis, const ChoiceQuestion& question)
{
    Table table{lowerCase(question.id()) + "_matches",
                question.id() +
                    ": correct matches, and 95 % intervals of their share by what varies: participants, participants "
                    "and fabrics, or independent trials (Wilson), which they are not",
                {"condition",
                 "matches of " + std::to_string(analysis.data.participants.size()),
                 {"correct", ColumnUse::InCsv},
                 {"trials", ColumnUse::InCsv},
                 {"correct of trials", ColumnUse::InDocuments},
                 "share",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI low, these fabrics", ColumnUse::InCsv},
                 {"95 % CI high, these fabrics", ColumnUse::InCsv},
                 {"95 % CI low, fabrics like these", ColumnUse::InCsv},
                 {"95 % CI high, fabrics like these", ColumnUse::InCsv},
                 {"95 % CI, these fabrics", ColumnUse::InDocuments},
                 {"95 % CI, fabrics like these", ColumnUse::InDocuments},
                 {"95 % CI, trials as independent", ColumnUse::InDocuments},
                 "p chance, trials",
                 {"p chance (Holm)", ColumnUse::InCsv},
                 {"p chance, participants", ColumnUse::InCsv}},
                {}};
    for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
        const ConditionChoices& choices = question.findings.conditions[i];
        const stats::Interval& ci = choices.againstChance.wilson;
        // Each condition stands there twice: these fabrics, fabrics like these.
        const stats::Interval& these = question.findings.claims.aboveChance[2 * i].claim.mean.ci95;
        const stats::Interval& alike = question.findings.claims.aboveChance[2 * i + 1].claim.mean.ci95;
        table.rows.push_back({conditionCell(analysis.data.conditions[i]), numberCell(choices.matchesPerRendering, 1),
                              countCell(choices.count.correct), countCell(choices.count.trials),
                              numericTextCell(std::to_string(choices.count.correct) + "/" + std::to_string(choices.count.trials)),
                              numberCell(choices.againstChance.estimate, 2), numberCell(ci.low, 2), numberCell(ci.high, 2),
                              numberCell(these.low, 2), numberCell(these.high, 2), numberCell(alike.low, 2),
                              numberCell(alike.high, 2), intervalCell(these, 2), intervalCell(alike, 2), intervalCell(ci, 2),
                              pCell(choices.againstChance.pGreater, choices.againstChance.logPGreater), pCell(choices.pHolm),
                              pCell(choices.participantsAgainstChance.p, choices.participantsAgainstChance.logP)});
    }
    return table;
}

Table matchesByFabricTable(const StudyAnalysis& analysis, const ChoiceQuestion& question)
{
    Table table{lowerCase(question.id()) + "_matches_by_fabric",
                question.id() + ": number of participants who matched each rendering with its fabric",
                {"condition"},
                {}};
    for (const std::string& fabric : analysis.data.fabrics) table.columns.emplace_back(fabric);
    for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
        std::vector<TableCell> row{conditionCell(analysis.data.conditions[i])};
        for (const CountCorrect& count : question.findings.conditions[i].byFabric) row.push_back(countCell(count.correct));
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace

std::vector<ReportTable> choiceTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    for (const ChoiceQuestion& question : questionsWith<ChoiceAnalysis>(analysis)) {
        tables.push_back({.table = matchesTable(analysis, question), .section = PageSection::Matches, .question = question.id()});
        tables.push_back({.table = matchesByFabricTable(analysis, question),
                          .section = PageSection::Matches,
                          .question = question.id(),
                          .foldedUnder = "Matches by fabric"});
    }
    return tables;
}

}  // namespace reports
