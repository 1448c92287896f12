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
                 "matches of " + std::to_string(answeringParticipants(analysis.data, question.findings)),
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

/// "number of participants who matched each rendering with its fabric". Several answers of one participant count one by one, and
/// the right word of a pair may be "different".
std::string countedByFabric(const StudyAnalysis& analysis, const ChoiceQuestion& question)
{
    const bool isOnce = answersPerCellOf(analysis.data, question.analysis.question) <= 1;
    if (ruleOfDPrime(question.findings) == DPrimeRule::OfHits)
        return isOnce ? "number of participants who gave the right answer to each rendering"
                      : "number of right answers to each rendering";
    return std::string("number of ") + (isOnce ? "participants who" : "answers that") + " matched each rendering with its fabric";
}

Table matchesByFabricTable(const StudyAnalysis& analysis, const ChoiceQuestion& question)
{
    Table table{lowerCase(question.id()) + "_matches_by_fabric",
                question.id() + ": " + countedByFabric(analysis, question),
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

/// What participants said to pairs that were the same, and to pairs that differed.
Table hitsTable(const StudyAnalysis& analysis, const ChoiceQuestion& question)
{
    Table table{
        lowerCase(question.id()) + "_hits",
        question.id() +
            ": “same” said of pairs that were the same (hits) and of pairs that differed (false alarms); sensitivity d′ and "
            "criterion c with 95 % intervals over participants, for these fabrics. c above 0: “different” is said more readily",
        {"condition",
         {"hits", ColumnUse::InCsv},
         {"same pairs", ColumnUse::InCsv},
         {"false alarms", ColumnUse::InCsv},
         {"different pairs", ColumnUse::InCsv},
         {"hits of same pairs", ColumnUse::InDocuments},
         {"false alarms of different pairs", ColumnUse::InDocuments},
         "hit rate",
         "false-alarm rate",
         "d′",
         {"d′ low", ColumnUse::InCsv},
         {"d′ high", ColumnUse::InCsv},
         {"95 % CI of d′", ColumnUse::InDocuments},
         "c",
         {"c low", ColumnUse::InCsv},
         {"c high", ColumnUse::InCsv},
         {"95 % CI of c", ColumnUse::InDocuments}},
        {}};
    const auto outOf = [](std::size_t said, std::size_t pairs) {
        return numericTextCell(std::to_string(said) + "/" + std::to_string(pairs));
    };
    for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
        const stats::MatchSensitivity& matches = *question.findings.conditions[i].matches;
        const stats::MatchCounts& counts = matches.counts;
        const stats::Interval& dPrime = matches.dPrime.overParticipants;
        const stats::Interval& criterion = matches.criterion.overParticipants;
        table.rows.push_back({conditionCell(analysis.data.conditions[i]), countCell(counts.hits), countCell(counts.same),
                              countCell(counts.falseAlarms), countCell(counts.different), outOf(counts.hits, counts.same),
                              outOf(counts.falseAlarms, counts.different), numberCell(matches.hitRate, 2),
                              numberCell(matches.falseAlarmRate, 2), numberCell(matches.dPrime.estimate, 2),
                              numberCell(dPrime.low, 2), numberCell(dPrime.high, 2), intervalCell(dPrime, 2),
                              numberCell(matches.criterion.estimate, 2), numberCell(criterion.low, 2),
                              numberCell(criterion.high, 2), intervalCell(criterion, 2)});
    }
    return table;
}

}  // namespace

std::vector<ReportTable> choiceTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    for (const ChoiceQuestion& question : questionsWith<ChoiceAnalysis>(analysis)) {
        tables.push_back({.table = matchesTable(analysis, question), .section = PageSection::Matches, .question = question.id()});
        if (ruleOfDPrime(question.findings) == DPrimeRule::OfHits)
            tables.push_back(
                {.table = hitsTable(analysis, question), .section = PageSection::Matches, .question = question.id()});
        tables.push_back({.table = matchesByFabricTable(analysis, question),
                          .section = PageSection::Matches,
                          .question = question.id(),
                          .foldedUnder = "Matches by fabric"});
    }
    return tables;
}

}  // namespace reports
