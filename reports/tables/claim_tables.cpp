#include "reports/tables/claim_tables.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/number_text.h"
#include "reports/analysis/claim_words.h"
#include "reports/formats/table_cells.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// "-1.20 to 0.45": the smallest and the largest mean difference on one fabric.
TableCell byFabricCell(const std::vector<stats::Value>& byFabric)
{
    std::vector<double> values;
    for (const stats::Value& value : byFabric)
        if (value.exists()) values.push_back(*value);
    if (values.empty()) return blankCell();
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return rangeCell(*low, *high, 2);
}

/// "2 of 7": in how many of the analyses with one left out the verdict is another.
TableCell changedCell(const ContrastFinding& finding, const std::vector<LeftOneOut>& list)
{
    if (list.empty()) return blankCell();
    const auto changed =
        std::count_if(list.begin(), list.end(), [&](const LeftOneOut& one) { return one.verdict != finding.claim.verdict; });
    return numericTextCell(std::to_string(changed) + " of " + std::to_string(list.size()));
}

std::string boundsText(const QuestionClaims& claims)
{
    if (!claims.bounds) return "";
    return "; equivalence within " + typeset(protocols::shortest(claims.bounds->first)) + " and " +
           typeset(protocols::shortest(claims.bounds->second));
}

Table contrastTable(const std::string& id, const QuestionClaims& claims)
{
    const bool hasPrimary = !claims.contrasts.empty() && claims.contrasts.front().primary;
    const std::string family = !arePlanned(claims) ? "all pairs of conditions"
                               : hasPrimary        ? "planned contrasts, the primary one first"
                                                   : "planned contrasts";
    Table table{"claims_" + lowerCase(id),
                id + ": " + family + boundsText(claims) + "; Holm's correction within the family",
                {"a",
                 "b",
                 "holds for",
                 "difference a\u2212b",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 {"90 % CI low", ColumnUse::InCsv},
                 {"90 % CI high", ColumnUse::InCsv},
                 "df",
                 {"p", ColumnUse::InCsv},
                 "p different",
                 {"p TOST", ColumnUse::InCsv},
                 "p equivalent",
                 "verdict",
                 "by fabric",
                 "changes without one fabric",
                 "changes without one participant"},
                {}};
    for (const ContrastFinding& finding : claims.contrasts) {
        const stats::ContrastClaim& claim = finding.claim;
        const stats::CrossedMean& mean = claim.mean;
        table.rows.push_back({conditionCell(finding.a), conditionCell(finding.b), oneLineCell(wordsOf(finding.generalisation)),
                              numberCell(mean.estimate, 2), numberCell(mean.ci95.low, 2), numberCell(mean.ci95.high, 2),
                              intervalCell(mean.ci95, 2), numberCell(mean.ci90.low, 2), numberCell(mean.ci90.high, 2),
                              numberCell(mean.df, 1), pCell(claim.difference.p, claim.difference.logP), pCell(claim.pAdjusted),
                              pCell(claim.equivalence.p, claim.equivalence.logP), pCell(claim.pEquivalenceAdjusted),
                              textCell(wordsOf(claim.verdict)), byFabricCell(finding.byFabric),
                              changedCell(finding, finding.withoutFabric), changedCell(finding, finding.withoutParticipant)});
    }
    return table;
}

/// "1.02", or the sign of infinity.
std::string dPrimeText(double dPrime) { return std::isinf(dPrime) ? "∞" : fixed(dPrime, 2); }

/// "1.02 [0.20, ∞]".
TableCell sensitivityCell(const ClusteredSensitivity& sensitivity)
{
    if (!sensitivity.dPrime.exists()) return numberCell(sensitivity.dPrime, 2);
    const bool isBounded = sensitivity.ci95.low.exists() && sensitivity.ci95.high.exists();
    const auto textWith = [&](const auto& textOf) {
        const std::string interval =
            isBounded ? " [" + textOf(*sensitivity.ci95.low) + ", " + textOf(*sensitivity.ci95.high) + "]" : "";
        return textOf(*sensitivity.dPrime) + interval;
    };
    TableCell cell = numericTextCell(textWith(dPrimeText));
    cell.html = textWith([](double dPrime) { return typeset(dPrimeText(dPrime)); });
    return cell;
}

/// There is no test where guessing is not right in 1/m of the answers, and where answers do not vary.
std::string aboveChanceText(const stats::ChanceClaim& claim)
{
    if (claim.isAbove) return "yes";
    return claim.above.p.exists() ? "not shown" : "not tested";
}

bool isTestedEverywhere(const ChoiceAnalysis& choices)
{
    return std::ranges::all_of(choices.conditions, [](const ConditionChoices& one) { return one.noChance.empty(); });
}

Table chanceTable(const std::string& id, const ChoiceAnalysis& choices)
{
    Table table{"above_chance_" + lowerCase(id),
                id + ": mean share correct against chance 1/" + std::to_string(choices.alternatives) +
                    ", with participants and fabrics as samples, Holm's correction over the conditions; " +
                    (ruleOfDPrime(choices) == DPrimeRule::OfHits
                         ? "d′ of hits and false alarms, with intervals by the jackknife"
                         : "d′ of that share, whose interval is that of the share in units of d′") +
                    (isTestedEverywhere(choices) ? "" : "; not tested where the pairs were not half the same"),
                {"condition",
                 "holds for",
                 "share",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "df",
                 {"p", ColumnUse::InCsv},
                 "p above chance",
                 "above chance",
                 {"d′", ColumnUse::InCsv},
                 {"d′ low", ColumnUse::InCsv},
                 {"d′ high", ColumnUse::InCsv},
                 {"d′ and its 95 % CI", ColumnUse::InDocuments}},
                {}};
    for (std::size_t i = 0; i < choices.claims.aboveChance.size(); ++i) {
        const ChanceFinding& finding = choices.claims.aboveChance[i];
        const ClusteredSensitivity& sensitivity = choices.sensitivities[i];
        const stats::CrossedMean& mean = finding.claim.mean;
        table.rows.push_back(
            {conditionCell(finding.condition), oneLineCell(wordsOf(finding.generalisation)), numberCell(mean.estimate, 2),
             numberCell(mean.ci95.low, 2), numberCell(mean.ci95.high, 2), intervalCell(mean.ci95, 2), numberCell(mean.df, 1),
             pCell(finding.claim.above.p, finding.claim.above.logP), pCell(finding.claim.pAdjusted),
             textCell(aboveChanceText(finding.claim)), numberCell(sensitivity.dPrime, 2), numberCell(sensitivity.ci95.low, 2),
             numberCell(sensitivity.ci95.high, 2), sensitivityCell(sensitivity)});
    }
    return table;
}

/// Each contrast with all participants and without the flagged ones.
Table claimsWithoutFlagged(const StudyAnalysis& analysis)
{
    std::vector<std::string> names;
    for (const ExcludedParticipant& one : analysis.screening.excluded) names.push_back(one.participant);
    Table table{
        "claims_without_flagged",
        "The claims with all participants, and without the flagged ones (" + listed(names) +
            "). The summary keeps all participants",
        {"question", "a", "b", "holds for", "difference, all", "difference, rest", "verdict, all", "verdict, rest", "changes"},
        {}};
    for (std::size_t q = 0; q < analysis.questions.size(); ++q) {
        const QuestionClaims* all = claimsOf(analysis.questions[q]);
        const QuestionClaims* rest = claimsOf(analysis.withoutFlagged->questions[q]);
        if (all == nullptr || rest == nullptr) continue;
        for (std::size_t i = 0; i < all->contrasts.size(); ++i) {
            const ContrastFinding &before = all->contrasts[i], &after = rest->contrasts[i];
            table.rows.push_back({textCell(analysis.questions[q].question.id), conditionCell(before.a), conditionCell(before.b),
                                  oneLineCell(wordsOf(before.generalisation)), numberCell(before.claim.mean.estimate, 2),
                                  numberCell(after.claim.mean.estimate, 2), textCell(wordsOf(before.claim.verdict)),
                                  textCell(wordsOf(after.claim.verdict)),
                                  textCell(before.claim.verdict == after.claim.verdict ? "" : "yes")});
        }
    }
    return table;
}

}  // namespace

void claimTables(const StudyAnalysis& analysis, const TakeTable& take)
{
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis))
        take(
            {.table = chanceTable(question.id(), question.findings), .section = PageSection::Matches, .question = question.id()});
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionClaims* claims = claimsOf(question); claims != nullptr && !claims->contrasts.empty())
            take({.table = contrastTable(question.question.id, *claims),
                  .section = PageSection::Claims,
                  .question = question.question.id,
                  .foldedUnder = arePlanned(*claims) ? "" : question.question.id + ": all pairs"});
    if (analysis.withoutFlagged)
        if (Table table = claimsWithoutFlagged(analysis); !table.rows.empty())
            take({.table = std::move(table),
                  .section = PageSection::Quality,
                  .foldedUnder = "Claims without flagged participants"});
}

}  // namespace reports
