#include "study/analyse/analyse_claims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "stats/claims/claims.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/tests/repeated_measures.h"
#include "study/analyse/analyse_answer.h"
#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;
using stats::Generalisation;

constexpr double mostContrastCells = 2e8;  // contrasts x participants x fabrics: some seconds
constexpr std::size_t mostFits = 50000;    // of claims with one participant or fabric left out

constexpr NamedChoice<Generalisation> generalisations[] = {{"these_fabrics", Generalisation::TheseFabrics},
                                                           {"fabrics_like_these", Generalisation::FabricsLikeThese}};
constexpr NamedChoice<stats::Tail> directions[] = {{"two-sided", stats::Tail::TwoSided},
                                                   {"two_sided", stats::Tail::TwoSided},
                                                   {"less", stats::Tail::Less},
                                                   {"greater", stats::Tail::Greater}};

std::string_view textOf(Generalisation generalisation)
{
    return generalisations[generalisation == Generalisation::TheseFabrics ? 0 : 1].name;
}

void checkCells(double participants, double fabrics, double conditions)
{
    if (participants * fabrics * conditions > mostCells)
        throw RequestFault("participants x fabrics x conditions are more than " + std::to_string(static_cast<long>(mostCells)) +
                           " cells; expected rows that cross participants with fabrics");
}

/// Estimate with its intervals; null with the reason where the mean cannot be tested.
void putMean(AnswerFields& answer, const stats::CrossedMean& mean)
{
    answer.put("estimate", mean.estimate).put("se", mean.se).put("df", mean.df).put("ci90", mean.ci90).put("ci95", mean.ci95);
    answer.putText("singular", mean.singular);
}

ordered_json crossedMean(const AnalysisRequest& request)
{
    const stats::CrossedValues rows{factorAt(request.inputs, "participant"), factorAt(request.inputs, "fabric"),
                                    numbersAt(request.inputs, "value")};
    for (const stats::Factor* factor : {&rows.participant, &rows.fabric})
        if (factor->of.size() != rows.values.size()) throw RequestFault(factor->name + " and value differ in length");
    checkCells(static_cast<double>(rows.participant.levels.size()), static_cast<double>(rows.fabric.levels.size()), 1);
    const auto generalisation = choiceOr(request.options, "generalises_to", generalisations, "fabrics_like_these");
    const auto tail = choiceOr(request.options, "alternative", directions, "two-sided");
    const auto bounds = boundsOf(request.options);
    const stats::CrossedMean mean = stats::crossedMean(rows, generalisation);
    if (!mean.why.empty()) return degenerate(mean.why);
    const stats::MeanTest test = stats::testOfMean(mean, numberOr(request.options, "mu", 0), tail);
    AnswerFields answer;
    answer.putText("generalises_to", textOf(generalisation)).putCount("values", mean.values);
    answer.putCount("participants", mean.participants).putCount("fabrics", mean.fabrics);
    putMean(answer, mean);
    answer.put("t", test.t).putProbability("p", test.p, test.logP).put("log_p", test.logP);
    if (bounds) {
        const stats::MeanTest equivalence = stats::equivalenceOfMean(mean, bounds->first, bounds->second);
        answer.putProbability("p_equivalence", equivalence.p, equivalence.logP).put("log_p_equivalence", equivalence.logP);
    }
    return answer.json();
}

/// The rows as one value for each cell; the repetitions of a cell are averaged.
stats::AnswerCube cubeOf(const stats::CrossedStudy& rows, stats::AnswerValues kind)
{
    const std::size_t participants = rows.participant.levels.size(), fabrics = rows.fabric.levels.size();
    stats::AnswerCube cube(kind, rows.condition.levels.size(), participants, fabrics);
    std::vector<double> sums(rows.condition.levels.size() * participants * fabrics);
    std::vector<std::size_t> counts(sums.size());
    for (std::size_t row = 0; row < rows.values.size(); ++row) {
        if (std::isnan(rows.values[row])) continue;
        const std::size_t c = rows.condition.of[row], p = rows.participant.of[row], f = rows.fabric.of[row];
        const std::size_t cell = (c * participants + p) * fabrics + f;
        sums[cell] += rows.values[row];
        cube.at(c, p, f) = sums[cell] / static_cast<double>(++counts[cell]);
    }
    return cube;
}

/// Choices are 1 and 0 alone.
stats::AnswerValues kindOf(const std::vector<double>& values)
{
    const bool areChoices =
        std::all_of(values.begin(), values.end(), [](double value) { return std::isnan(value) || value == 0 || value == 1; });
    return areChoices ? stats::AnswerValues::Choices : stats::AnswerValues::Ratings;
}

/// The contrasts again without one participant or one fabric.
struct ClaimsWithout {
    std::string leftOut;
    std::vector<stats::ContrastClaim> claims;
};

struct ClaimFamily {
    const stats::AnswerCube& cube;
    const stats::CrossedStudy& rows;
    std::vector<stats::ContrastPair> contrasts;
    std::optional<stats::Bounds> bounds;

    std::vector<stats::ContrastClaim> claims(const stats::AnswerCube& answers, Generalisation generalisation) const
    {
        return stats::contrastClaims(answers, contrasts, bounds, generalisation);
    }
    std::vector<ClaimsWithout> withoutFabrics(Generalisation generalisation) const
    {
        std::vector<ClaimsWithout> result;
        for (std::size_t f = 0; f < cube.fabrics() && cube.fabrics() > 1; ++f)
            result.push_back({rows.fabric.levels[f], claims(cube.withoutFabric(f), generalisation)});
        return result;
    }
    std::vector<ClaimsWithout> withoutParticipants(Generalisation generalisation) const
    {
        std::vector<ClaimsWithout> result;
        for (std::size_t p = 0; p < cube.participants() && cube.participants() > 1; ++p)
            result.push_back({rows.participant.levels[p], claims(cube.withoutParticipant(p), generalisation)});
        return result;
    }
};

ordered_json withoutJson(const std::vector<ClaimsWithout>& without, std::size_t contrast, const char* name)
{
    ordered_json list = ordered_json::array();
    for (const ClaimsWithout& one : without) {
        const stats::ContrastClaim& claim = one.claims[contrast];
        AnswerFields row;
        row.putText(name, one.leftOut).put("estimate", claim.mean.estimate).put("ci90", claim.mean.ci90);
        list.push_back(row.putText("verdict", stats::nameOf(claim.verdict)).json());
    }
    return list;
}

AnswerFields claimFields(const ClaimFamily& family, const stats::ContrastClaim& claim, Generalisation generalisation)
{
    AnswerFields row;
    row.putText("a", family.rows.condition.levels[claim.a]).putText("b", family.rows.condition.levels[claim.b]);
    row.putText("generalises_to", textOf(generalisation));
    putMean(row, claim.mean);
    row.put("t", claim.difference.t).putProbability("p", claim.difference.p, claim.difference.logP);
    row.put("log_p", claim.difference.logP).put("p_adjusted", claim.pAdjusted);
    row.putProbability("p_equivalence", claim.equivalence.p, claim.equivalence.logP);
    return row.put("p_equivalence_adjusted", claim.pEquivalenceAdjusted).putText("verdict", stats::nameOf(claim.verdict));
}

/// Each contrast twice: for these fabrics, then for fabrics like these.
ordered_json claimsJson(const ClaimFamily& family, bool leaveOneOut)
{
    std::vector<std::vector<ordered_json>> rows(family.contrasts.size());
    for (const auto& [name, generalisation] : generalisations) {
        const auto claims = family.claims(family.cube, generalisation);
        const auto fabrics = leaveOneOut ? family.withoutFabrics(generalisation) : std::vector<ClaimsWithout>();
        const auto participants = leaveOneOut ? family.withoutParticipants(generalisation) : std::vector<ClaimsWithout>();
        for (std::size_t i = 0; i < claims.size(); ++i) {
            AnswerFields row = claimFields(family, claims[i], generalisation);
            if (leaveOneOut)
                row.putText("without_fabric", withoutJson(fabrics, i, "fabric"))
                    .putText("without_participant", withoutJson(participants, i, "participant"));
            rows[i].push_back(row.json());
        }
    }
    ordered_json list = ordered_json::array();
    for (const auto& both : rows)
        for (const ordered_json& row : both) list.push_back(row);
    return list;
}

ordered_json aboveChanceJson(const ClaimFamily& family, double chance)
{
    std::vector<std::vector<ordered_json>> rows(family.cube.conditions());
    for (const auto& [name, generalisation] : generalisations) {
        const auto claims = stats::chanceClaims(family.cube, chance, generalisation);
        for (std::size_t c = 0; c < claims.size(); ++c) {
            AnswerFields row;
            row.putText("condition", family.rows.condition.levels[c]).putText("generalises_to", name);
            putMean(row, claims[c].mean);
            row.put("t", claims[c].above.t).putProbability("p", claims[c].above.p, claims[c].above.logP);
            rows[c].push_back(row.put("p_adjusted", claims[c].pAdjusted).putText("above", claims[c].isAbove).json());
        }
    }
    ordered_json list = ordered_json::array();
    for (const auto& both : rows)
        for (const ordered_json& row : both) list.push_back(row);
    return list;
}

/// A participant's means under the conditions, over the fabrics that were answered under all of them: a missing answer must not
/// make a difference of fabrics look like one of conditions. Empty without such a fabric.
std::vector<double> commonMeans(const stats::AnswerCube& cube, std::size_t participant)
{
    std::vector<std::vector<double>> common(cube.conditions());
    for (std::size_t f = 0; f < cube.fabrics(); ++f) {
        std::vector<double> cells;
        for (std::size_t c = 0; c < cube.conditions(); ++c) cells.push_back(cube.at(c, participant, f));
        if (std::any_of(cells.begin(), cells.end(), [](double cell) { return std::isnan(cell); })) continue;
        for (std::size_t c = 0; c < cube.conditions(); ++c) common[c].push_back(cells[c]);
    }
    std::vector<double> means;
    if (common.front().empty()) return means;
    // A mean that is not finite stays one, so that the test refuses it.
    for (const std::vector<double>& cells : common)
        means.push_back(stats::meanOf(cells).orElse(std::numeric_limits<double>::infinity()));
    return means;
}

/// Repeated-measures ANOVA of the means of the participants who have a fabric under all conditions.
stats::RepeatedMeasuresAnova anovaOfParticipants(const stats::AnswerCube& cube)
{
    std::vector<std::vector<double>> rows;
    for (std::size_t p = 0; p < cube.participants(); ++p)
        if (auto means = commonMeans(cube, p); !means.empty()) rows.push_back(std::move(means));
    return stats::repeatedMeasuresAnova(stats::blockTableOf(rows).table);
}

/// One row for each cell, with the mean of its repetitions, where the first of them stood. Rows that are no cell's first are
/// left out.
stats::CrossedStudy rowsOfCells(const stats::CrossedStudy& rows, const stats::AnswerCube& cube)
{
    stats::CrossedStudy cells{rows.participant, rows.fabric, rows.condition, {}};
    for (stats::Factor* factor : {&cells.participant, &cells.fabric, &cells.condition}) factor->of.clear();
    std::vector<bool> wasTaken(cube.conditions() * cube.participants() * cube.fabrics());
    for (std::size_t row = 0; row < rows.values.size(); ++row) {
        const std::size_t c = rows.condition.of[row], p = rows.participant.of[row], f = rows.fabric.of[row];
        const std::size_t cell = (c * cube.participants() + p) * cube.fabrics() + f;
        if (std::isnan(rows.values[row]) || wasTaken[cell]) continue;
        wasTaken[cell] = true;
        cells.condition.of.push_back(c);
        cells.participant.of.push_back(p);
        cells.fabric.of.push_back(f);
        cells.values.push_back(cube.at(c, p, f));
    }
    return cells;
}

ordered_json omnibusJson(const ClaimFamily& family)
{
    const stats::RepeatedMeasuresAnova anova = anovaOfParticipants(family.cube);
    const bool exists = anova.pGg.exists() && anova.epsilonGg.exists();
    const stats::Value none = stats::Value::undefined(anova.pGg.exists() ? anova.epsilonGg.why() : anova.pGg.why());
    AnswerFields these, alike;
    these.putText("generalises_to", textOf(Generalisation::TheseFabrics)).put("statistic", exists ? anova.f : none);
    these.put("df1", exists ? stats::Value(*anova.df1 * *anova.epsilonGg) : none);
    these.put("df2", exists ? stats::Value(*anova.df2 * *anova.epsilonGg) : none);
    these.putProbability("p", exists ? anova.pGg : none, anova.logPGg);
    const stats::FTest test = stats::conditionForOthers(stats::fitRatings(rowsOfCells(family.rows, family.cube)));
    alike.putText("generalises_to", textOf(Generalisation::FabricsLikeThese)).put("statistic", test.f).put("df1", test.df1);
    alike.put("df2", test.df2).putProbability("p", test.p, test.logP);
    return {these.json(), alike.json()};
}

ordered_json claims(const AnalysisRequest& request)
{
    const stats::CrossedStudy rows = crossedRowsAt(request.inputs, "value");
    if (rows.values.empty()) return degenerate("there are no rows");
    if (rows.condition.levels.size() < 2) return degenerate("there is one condition only: nothing to compare");
    const auto sizeOf = [](const stats::Factor& factor) { return static_cast<double>(factor.levels.size()); };
    checkCells(sizeOf(rows.participant), sizeOf(rows.fabric), sizeOf(rows.condition));
    const stats::AnswerCube cube = cubeOf(rows, kindOf(rows.values));
    const ClaimFamily family{cube, rows, contrastsOf(request.options, rows.condition.levels), boundsOf(request.options)};
    checkSize("contrasts x participants x fabrics",
              static_cast<double>(family.contrasts.size()) * sizeOf(rows.participant) * sizeOf(rows.fabric), mostContrastCells);
    const bool leaveOneOut = truthOr(request.options, "leave_one_out", false);
    const double chance = numberOr(request.options, "chance", std::numeric_limits<double>::quiet_NaN());
    if (leaveOneOut && family.contrasts.size() * (cube.participants() + cube.fabrics()) > mostFits)
        throw RequestFault("leave_one_out takes more than " + std::to_string(mostFits) +
                           " fits for these contrasts; expected fewer contrasts");
    ordered_json answer{
        {"conditions", rows.condition.levels}, {"omnibus", omnibusJson(family)}, {"claims", claimsJson(family, leaveOneOut)}};
    if (!std::isnan(chance)) answer["above_chance"] = aboveChanceJson(family, chance);
    return answer;
}

}  // namespace

std::vector<NamedAnalysis> analysesOfClaims()
{
    return {
        {"crossed_mean", crossedMean, "value participant fabric", "[generalises_to] [mu] [alternative] [bounds]",
         "mean of participants crossed with fabrics"},
        {"claims", claims, "value condition participant [fabric]", "[contrasts] [bounds] [chance] [leave_one_out]",
         "contrasts, equivalence and chance, for these fabrics and for fabrics like these"},
    };
}

}  // namespace study::analyse
