#include "stats/power/planted_claims.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <optional>

#include "stats/claims/two_condition_model.h"
#include "stats/kernels/threads.h"
#include "stats/power/logistic_share.h"
#include "stats/tests/multiplicity.h"

namespace stats {
namespace {

constexpr double plantedDifferences[] = {0, 0.5, 1, 2};  // scale points
constexpr double plantedBounds[] = {1, 1.5};             // scale points

/// A family of contrasts; the first one is decided.
struct PlantedFamily {
    std::string name;
    std::vector<ContrastPair> contrasts;
};

/// Numbers the conditions so that the first contrast begins with condition 0, which is the planted one.
std::vector<ContrastPair> renumbered(const PlantedOptions& options)
{
    std::vector<ContrastPair> contrasts = options.contrasts;
    if (contrasts.empty()) return {{0, 1}};
    const std::size_t planted = contrasts.front().first;
    const auto swapped = [&](std::size_t c) { return c == planted ? 0 : c == 0 ? planted : c; };
    for (auto& [a, b] : contrasts) a = swapped(a), b = swapped(b);
    return contrasts;
}

std::vector<PlantedFamily> familiesOf(const PlantedOptions& options)
{
    const std::vector<ContrastPair> planned = renumbered(options);
    std::vector<ContrastPair> all = allPairs(options.design.conditions);
    const ContrastPair first = planned.front();  // begins with condition 0, as the first pairs do
    std::rotate(all.begin(), std::ranges::find(all, first), std::ranges::find(all, first) + 1);
    const auto afterHolm = [](std::size_t contrasts) { return "after Holm of " + std::to_string(contrasts); };
    std::vector<PlantedFamily> families{{"first contrast", {first}}};
    if (planned.size() > 1 && planned.size() < all.size()) families.push_back({afterHolm(planned.size()), planned});
    if (all.size() > 1) families.push_back({afterHolm(all.size()), all});
    return families;
}

std::string shortNumber(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%g", x);
    return text;
}

/// The decisions to count; without bounds: "different".
struct PlantedDecision {
    std::optional<double> bound;
    std::size_t family = 0;
};

std::vector<PlantedDecision> decisionsOf(const PlantedTruth& truth, std::size_t families)
{
    std::vector<PlantedDecision> decisions;
    if (truth.interactions.isChoice) return decisions;
    if (truth.difference > 0)
        for (std::size_t family = 0; family < families; ++family) decisions.push_back({{}, family});
    for (const double bound : plantedBounds)
        for (std::size_t family = 0; family < families && truth.difference < bound; ++family)
            decisions.push_back({bound, family});
    return decisions;
}

std::string nameOf(const PlantedDecision& decision, const std::vector<PlantedFamily>& families)
{
    const std::string what = decision.bound ? "equivalent within +-" + shortNumber(*decision.bound) : "different";
    return what + ", " + families[decision.family].name;
}

/// A drawn study and the true means of its conditions: of the population, or on these fabrics.
struct PlantedStudy {
    AnswerCube answers;
    std::vector<double> means;
};

PlantedStudy drawnPlanted(const PlantedTruth& truth, const PlantedOptions& options, Generalisation generalisation,
                          std::span<const double> intercepts, Draws& draws)
{
    const ClaimNull& null = truth.interactions;
    std::vector<double> means(options.design.conditions);
    if (!null.isChoice) {
        means.front() = truth.difference;
        const double step = options.ratings.scaleStep;
        return {drawnStudy(options.design, null, generalisation, draws,
                           [&](const DrawnCell& cell) {
                               const double raw =
                                   options.ratings.centre + means[cell.condition] + cell.effects + draws.normal(claimResidualSd);
                               return std::round(raw / step) * step;
                           }),
                means};
    }
    const auto fabrics = static_cast<double>(options.design.fabrics);
    const bool ofTheseFabrics = generalisation == Generalisation::TheseFabrics;
    AnswerCube answers = drawnStudy(options.design, null, Generalisation::FabricsLikeThese, draws, [&](const DrawnCell& cell) {
        const double intercept = intercepts[cell.condition];
        if (ofTheseFabrics && cell.participant == 0)
            means[cell.condition] += meanShare(intercept + cell.ofFabric, null.participantsSd(cell.condition)) / fabrics;
        return draws.happens(shareOfLogOdds(intercept + cell.effects)) ? 1.0 : 0.0;
    });
    return {std::move(answers), std::move(means)};
}

bool isRight(const Value& p, const Value& estimate, const PlantedDecision& decision)
{
    if (!p.exists() || *p >= claimAlpha) return false;
    return decision.bound || *estimate > 0;
}

/// What the claims of the report decide, in the order of the decisions.
std::vector<double> decidedByClaims(const AnswerCube& answers, std::span<const PlantedDecision> decisions,
                                    const std::vector<PlantedFamily>& families, Generalisation generalisation)
{
    std::vector<double> right;
    for (const PlantedDecision& decision : decisions) {
        const auto bounds = decision.bound ? std::optional(Bounds{-*decision.bound, *decision.bound}) : std::nullopt;
        const ContrastClaim claim = contrastClaims(answers, families[decision.family].contrasts, bounds, generalisation).front();
        right.push_back(
            isRight(decision.bound ? claim.pEquivalenceAdjusted : claim.pAdjusted, claim.mean.estimate, decision) ? 1 : 0);
    }
    return right;
}

std::vector<double> decidedByReference(const AnswerCube& answers, std::span<const PlantedDecision> decisions,
                                       const std::vector<PlantedFamily>& families)
{
    std::vector<double> right;
    StudentQuantiles quantiles;
    std::vector<std::vector<CrossedMean>> means;
    for (const PlantedFamily& family : families) {
        means.emplace_back();
        for (const auto& [a, b] : family.contrasts)
            means.back().push_back(differenceByTwoConditionModel(answers.tableUnder(a), answers.tableUnder(b), quantiles));
    }
    for (const PlantedDecision& decision : decisions) {
        std::vector<Value> p;
        for (const CrossedMean& mean : means[decision.family])
            p.push_back(decision.bound ? equivalenceOfMean(mean, -*decision.bound, *decision.bound).p
                                       : testOfMean(mean, 0, Tail::TwoSided).p);
        right.push_back(isRight(adjusted(p, Adjustment::Holm).front(), means[decision.family].front().estimate, decision) ? 1
                                                                                                                          : 0);
    }
    return right;
}

/// Number of the 95 % intervals of all pairs that hold the true difference. `meanOf(a, b)` gives the interval.
template <class MeanOf>
double heldBy(const std::vector<double>& means, const MeanOf& meanOfPair)
{
    double held = 0;
    for (const auto& [a, b] : allPairs(means.size())) {
        const Interval interval = meanOfPair(a, b).ci95;
        const double truth = means[a] - means[b];
        if (interval.low.exists() && *interval.low <= truth && truth <= *interval.high) ++held;
    }
    return held;
}

/// One study of each generalisation; the counts of each row: these, alike, reference.
std::vector<std::array<double, 3>> plantedNumbers(const PlantedTruth& truth, const PlantedOptions& options,
                                                  std::span<const double> intercepts, const std::vector<PlantedFamily>& families,
                                                  const std::vector<PlantedDecision>& decisions, Draws& draws)
{
    std::vector<std::array<double, 3>> numbers(decisions.size() + 1);
    StudentQuantiles quantiles;
    for (const Generalisation generalisation : {Generalisation::TheseFabrics, Generalisation::FabricsLikeThese}) {
        const PlantedStudy study = drawnPlanted(truth, options, generalisation, intercepts, draws);
        const std::size_t column = generalisation == Generalisation::TheseFabrics ? 0 : 1;
        const auto right = decidedByClaims(study.answers, decisions, families, generalisation);
        for (std::size_t i = 0; i < right.size(); ++i) numbers[i][column] = right[i];
        const Degrees degrees = degreesOf(study.answers);
        numbers.back()[column] = heldBy(study.means, [&](std::size_t a, std::size_t b) {
            return differenceOf(study.answers, {a, b}, generalisation, degrees, quantiles);
        });
        if (column == 0) continue;
        const auto byReference = decidedByReference(study.answers, decisions, families);
        for (std::size_t i = 0; i < byReference.size(); ++i) numbers[i][2] = byReference[i];
        numbers.back()[2] = heldBy(study.means, [&](std::size_t a, std::size_t b) {
            return differenceByTwoConditionModel(study.answers.tableUnder(a), study.answers.tableUnder(b), quantiles);
        });
    }
    return numbers;
}

}  // namespace

std::string PlantedTruth::text() const
{
    return interactions.text() + (interactions.isChoice ? "" : ", difference of " + shortNumber(difference));
}

std::vector<PlantedTruth> plantedTruths()
{
    std::vector<PlantedTruth> truths;
    for (const ClaimNull& null : claimNulls())
        for (const double difference : plantedDifferences)
            if (!null.isChoice || difference == 0) truths.push_back({null, difference});
    return truths;
}

void StudyMean::add(double count)
{
    ++studies;
    sum += count;
    sumOfSquares += count * count;
}

double StudyMean::mean() const { return studies == 0 ? 0 : sum / static_cast<double>(studies) / static_cast<double>(each); }

double StudyMean::se() const
{
    if (studies < 2) return 0;
    const auto n = static_cast<double>(studies), most = static_cast<double>(each);
    return std::sqrt(std::max(0.0, sumOfSquares / n / (most * most) - mean() * mean()) / (n - 1));
}

PlantedCell plantedCell(const PlantedTruth& truth, const PlantedOptions& options)
{
    const StudyDesign& design = options.design;
    assert(design.participants > 1 && design.fabrics > 1 && design.conditions > 1);
    const std::vector<PlantedFamily> families = familiesOf(options);
    const std::vector<PlantedDecision> decisions = decisionsOf(truth, families.size());
    std::vector<double> intercepts;
    for (std::size_t c = 0; c < design.conditions && truth.interactions.isChoice; ++c)
        intercepts.push_back(
            interceptFor(contrastShare, std::hypot(truth.interactions.participantsSd(c), truth.interactions.fabricsSd(c))));
    PlantedCell cell{truth, {}};
    for (const PlantedDecision& decision : decisions) cell.rows.push_back({nameOf(decision, families), false, {}, {}, {}, {}});
    const StudyMean ofPairs{0, 0, 0, allPairs(design.conditions).size()};
    cell.rows.push_back({"95 % interval holds the truth", true, ofPairs, ofPairs, ofPairs, ofPairs});
    const SimulationOptions& simulation = options.simulation;
    std::vector<std::vector<std::array<double, 3>>> numbers(simulation.ownStudies());
    const auto finishedOne = [&](std::size_t) { simulation.done(1); };
    onThreads(
        simulation.ownStudies(), simulation.threads,
        [&](std::size_t study) {
            Draws draws(simulation.seed, simulation.share.item(study));
            numbers[study] = plantedNumbers(truth, options, intercepts, families, decisions, draws);
        },
        simulation.done ? finishedOne : std::function<void(std::size_t)>());
    for (const auto& ofStudy : numbers)
        for (std::size_t i = 0; i < ofStudy.size(); ++i) {
            const auto& [these, alike, reference] = ofStudy[i];
            PlantedRow& row = cell.rows[i];
            row.these.add(these);
            row.alike.add(alike);
            row.reference.add(reference);
            row.alikeMinusReference.add(alike - reference);
        }
    return cell;
}

namespace {

std::vector<PlantedTruth> plantedTruthsOf(const PlantedOptions& options)
{
    const StudyDesign& design = options.design;
    if (design.participants < 2 || design.fabrics < 2 || design.conditions < 2) return {};
    std::vector<PlantedTruth> truths = plantedTruths();
    std::erase_if(truths, [&](const PlantedTruth& truth) {
        return truth.interactions.isChoice ? !options.hasChoices : !options.hasRatings;
    });
    return truths;
}

}  // namespace

std::vector<PlantedCell> plantedCells(const PlantedOptions& options)
{
    std::vector<PlantedCell> cells;
    for (const PlantedTruth& truth : plantedTruthsOf(options)) {
        if (options.counted)
            if (std::vector<PlantedRow> rows = options.counted(truth.text(), options.simulation.ownStudies()); !rows.empty()) {
                cells.push_back({truth, std::move(rows)});
                if (options.simulation.done) options.simulation.done(options.simulation.ownStudies());
                continue;
            }
        cells.push_back(plantedCell(truth, options));
        if (options.finished) options.finished(truth.text(), cells.back().rows);
    }
    return cells;
}

std::size_t plantedClaimStudies(const PlantedOptions& options)
{
    return plantedTruthsOf(options).size() * options.simulation.ownStudies();
}

}  // namespace stats
