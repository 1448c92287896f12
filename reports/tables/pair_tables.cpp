#include "reports/tables/pair_tables.h"

#include "protocols/files/number_text.h"
#include "reports/analysis/claim_words.h"
#include "reports/formats/table_cells.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// A table of one question has no column for it in documents; one of all questions has.
enum class PairScope { OneQuestion, AllQuestions };

ColumnUse questionColumnUse(PairScope scope)
{
    return scope == PairScope::OneQuestion ? ColumnUse::InCsv : ColumnUse::Everywhere;
}

Table comparisonTable(const std::string& name, const std::string& caption, PairScope scope)
{
    return {name,
            caption,
            {{"question", questionColumnUse(scope)},
             "a",
             "b",
             "n",
             "difference a\u2212b",
             {"95 % CI low", ColumnUse::InCsv},
             {"95 % CI high", ColumnUse::InCsv},
             {"95 % CI", ColumnUse::InDocuments},
             "t",
             "df",
             "p",
             "p (Holm)",
             "d_z"},
            {}};
}

void addRow(Table& table, const std::string& question, const PairComparison& comparison)
{
    const stats::TTest& test = comparison.test;
    table.rows.push_back({textCell(question), conditionCell(comparison.pair.a), conditionCell(comparison.pair.b),
                          countCell(test.n), numberCell(test.estimate, 2), numberCell(test.ci.low, 2),
                          numberCell(test.ci.high, 2), intervalCell(test.ci, 2), numberCell(test.t, 2), numberCell(test.df, 0),
                          pCell(test.p, test.logP), pCell(comparison.pHolm), numberCell(test.dZ, 2)});
}

Table equivalenceTable(const std::string& name, const std::string& caption, PairScope scope)
{
    return {name,
            caption,
            {{"question", questionColumnUse(scope)},
             "a",
             "b",
             "n",
             "difference a\u2212b",
             {"90 % CI low", ColumnUse::InCsv},
             {"90 % CI high", ColumnUse::InCsv},
             {"90 % CI", ColumnUse::InDocuments},
             "p above low bound",
             "p below high bound",
             "p (TOST)",
             "verdict"},
            {}};
}

void addRow(Table& table, const std::string& question, const PairEquivalence& equivalence)
{
    const stats::EquivalenceTest& test = equivalence.test;
    table.rows.push_back({textCell(question), conditionCell(equivalence.pair.a), conditionCell(equivalence.pair.b),
                          countCell(test.n), numberCell(test.estimate, 2), numberCell(test.ci.low, 2),
                          numberCell(test.ci.high, 2), intervalCell(test.ci, 2), pCell(test.pLower, test.logPLower),
                          pCell(test.pUpper, test.logPUpper), pCell(test.p, test.logP),
                          textCell(tableWords(equivalence.verdict))});
}

std::string boundsText(const StudyData& data)
{
    const auto [low, high] = data.equivalenceBounds;
    const std::string text = typeset(protocols::shortest(low)) + " and " + typeset(protocols::shortest(high)) + " scale points";
    return mirroredPairs(data).empty() ? text : text + ", which are mirrored where b\u2212a is planned";
}

/// The rows of the planned pairs of all questions.
template <class Pairs>
void addPlanned(Table& table, const StudyAnalysis& analysis, const Pairs& pairsOf)
{
    for (const QuestionAnalysis& question : analysis.questions)
        for (const auto& pair : pairsOf(question))
            if (pair.pair.planned) addRow(table, question.question.id, pair);
}

void addPlannedTables(const StudyAnalysis& analysis, const TakeTable& take)
{
    Table comparisons = comparisonTable("comparisons_planned",
                                        "Planned contrasts: paired t tests of the participants' means, for these fabrics only",
                                        PairScope::AllQuestions);
    addPlanned(comparisons, analysis, comparisonsOf);
    if (comparisons.rows.empty()) return;
    Table equivalences =
        equivalenceTable("equivalence_planned",
                         "Planned contrasts: two one-sided tests of the participants' means against the bounds " +
                             boundsText(analysis.data) + ", for these fabrics only",
                         PairScope::AllQuestions);
    addPlanned(equivalences, analysis, equivalencesOf);
    take({.table = std::move(comparisons), .section = PageSection::Comparisons});
    const bool hasEquivalences = !equivalences.rows.empty();
    take({.table = std::move(equivalences), .section = PageSection::Equivalence, .onPage = hasEquivalences});
}

ReportTable comparisonsOfQuestion(const std::string& id, const std::vector<PairComparison>& comparisons)
{
    Table table = comparisonTable("comparisons_" + lowerCase(id),
                                  id + ": all pairs, paired t tests of the participants' means, for these fabrics only; Holm's "
                                       "correction over all pairs",
                                  PairScope::OneQuestion);
    for (const PairComparison& comparison : comparisons) addRow(table, id, comparison);
    return {.table = std::move(table), .section = PageSection::Comparisons, .question = id, .foldedUnder = id + ": all pairs"};
}

ReportTable equivalencesOfQuestion(const StudyData& data, const std::string& id, const std::vector<PairEquivalence>& equivalences)
{
    Table table = equivalenceTable("equivalence_" + lowerCase(id),
                                   id + ": all pairs, two one-sided tests of the participants' means against the bounds " +
                                       boundsText(data) + ", for these fabrics only",
                                   PairScope::OneQuestion);
    for (const PairEquivalence& equivalence : equivalences) addRow(table, id, equivalence);
    return {.table = std::move(table), .section = PageSection::Equivalence, .question = id, .foldedUnder = id + ": all pairs"};
}

}  // namespace

void pairTables(const StudyAnalysis& analysis, const TakeTable& take)
{
    addPlannedTables(analysis, take);
    for (const QuestionAnalysis& question : analysis.questions)
        std::visit(
            protocols::Overloaded{
                [&](const ChoiceAnalysis& choices) { take(comparisonsOfQuestion(question.question.id, choices.comparisons)); },
                [&](const RatingAnalysis& ratings) {
                    const std::string& id = question.question.id;
                    take(comparisonsOfQuestion(id, ratings.comparisons));
                    take(equivalencesOfQuestion(analysis.data, id, ratings.equivalences));
                },
                [](const WordedAnalysis&) {},
            },
            question.findings);
}

}  // namespace reports
