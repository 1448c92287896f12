#include "stats/power/power_groups.h"

#include <algorithm>
#include <cmath>

#include "stats/power/power.h"
#include "stats/tests/binomial.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "stats/tests/t_tests.h"

namespace stats {
namespace {

constexpr double reportAlpha = 0.05;
constexpr double largestLogOddsRange = 10;  // from 0.7 % to 99.3 % right
constexpr double largestStandardised = 10;

using Draw = std::function<void(CrossedStudy& study, double effect, Draws& draws)>;
using Analyse = std::function<void(const CrossedStudy& study, std::span<Value> p)>;

/// An analysis of a crossed study of this design.
auto crossed(const StudyDesign& design, Draw draw, Analyse analyse)
{
    return [empty = emptyStudy(design), draw = std::move(draw), analyse = std::move(analyse)](double effect, Draws& draws,
                                                                                              std::span<Value> p) {
        CrossedStudy study = empty;
        draw(study, effect, draws);
        analyse(study, p);
    };
}

/// Ratings whose conditions have the means that an effect makes.
Draw ratings(const RatingTruth& truth, std::vector<double> (*means)(std::size_t conditions, double effect))
{
    return [truth, means](CrossedStudy& study, double effect, Draws& draws) {
        drawRatings(study, truth, means(study.condition.levels.size(), effect), draws);
    };
}

/// Only the first two conditions differ, half the effect to either side of the others.
std::vector<double> firstPairApart(std::size_t conditions, double effect)
{
    std::vector<double> means(conditions);
    means[0] = effect / 2;
    means[1] = -effect / 2;
    return means;
}

double scaleOf(const PowerOptions& options) { return options.ratings.scaleMax - options.ratings.scaleMin; }

/// A twentieth, a tenth and three twentieths of the scale.
std::vector<double> sharesOfScale(const PowerOptions& options)
{
    const double scale = scaleOf(options);
    return {0.05 * scale, 0.1 * scale, 0.15 * scale};
}

double spreadOf(const StudyDesign& design, double range) { return sumOfSquares(evenlySpaced(design.conditions, range)); }

double pairsOf(const StudyDesign& design) { return static_cast<double>(design.conditions * (design.conditions - 1)) / 2; }

double logOddsOf(double probability) { return std::log(probability / (1 - probability)); }

/// The p of the first pair, corrected by Holm for all pairs.
Value firstPairAfterHolm(const BlockTable& table)
{
    std::vector<Value> p;
    for (std::size_t a = 0; a < table.conditions; ++a)
        for (std::size_t b = a + 1; b < table.conditions; ++b) p.push_back(pairedTTest(table.column(a), table.column(b)).p);
    return adjusted(p, Adjustment::Holm).front();
}

PowerGroup oneDifference(const PowerOptions& options)
{
    const RatingTruth truth = ofTheseFabrics(options.ratings);
    const double scale = scaleOf(options);
    const auto power = [truth](const StudyDesign& design, double effect, double level) {
        return tTestPower(static_cast<double>(design.participants), effect / truth.sdOfDifference(design), level);
    };
    PowerGroup group{"ratings", "difference of two conditions, scale points", sharesOfScale(options), {}, {}};
    group.tests = {{"paired t of participants' means", [=](const auto& d, double e) { return power(d, e, reportAlpha); }, scale},
                   {"the same after Holm over all pairs, no other differing",
                    [=](const auto& d, double e) { return power(d, e, reportAlpha / pairsOf(d)); }, scale}};
    group.analysis = crossed(options.design, ratings(truth, firstPairApart), [](const CrossedStudy& study, std::span<Value> p) {
        const BlockTable table = participantMeans(study);
        p[0] = pairedTTest(table.column(0), table.column(1)).p;
        p[1] = firstPairAfterHolm(table);
    });
    return group;
}

PowerGroup equivalence(const PowerOptions& options)
{
    const RatingTruth truth = ofTheseFabrics(options.ratings);
    const double low = options.equivalenceBounds.first;
    const double high = options.equivalenceBounds.second;
    const double middle = (low + high) / 2;
    const double reach = high - middle;
    PowerGroup group{"ratings", "true difference of two conditions, scale points", {}, {}, {}};
    group.effects = {middle, middle + reach / 4, middle + reach / 2};
    group.tests = {
        {"equivalence (TOST) of participants' means", [=](const StudyDesign& d, double e) {
             return equivalencePower({static_cast<double>(d.participants), truth.sdOfDifference(d), low, high, reportAlpha}, e);
         }}};
    group.analysis = crossed(options.design, ratings(truth, firstPairApart), [=](const CrossedStudy& study, std::span<Value> p) {
        const BlockTable table = participantMeans(study);
        p[0] = equivalenceTest(TKind::Paired, table.column(0), table.column(1), {low, high, reportAlpha}).p;
    });
    return group;
}

PowerGroup oneModelledDifference(const PowerOptions& options)
{
    const RatingTruth truth = options.ratings;
    PowerGroup group{"ratings", "difference of two conditions over all fabrics, scale points", sharesOfScale(options), {}, {}};
    group.tests = {{"mixed model, t of a difference", [=](const auto& d, double e) { return ratingDifferencePower(d, truth, e); },
                    scaleOf(options)}};
    group.analysis = crossed(options.design, ratings(truth, firstPairApart), [](const CrossedStudy& study, std::span<Value> p) {
        p[0] = levelDifference(fitRatings(study).model, 0, 1).p;
    });
    return group;
}

PowerGroup allConditions(const PowerOptions& options)
{
    const RatingTruth truth = ofTheseFabrics(options.ratings);
    const double scale = scaleOf(options);
    PowerGroup group{"ratings", "range of evenly spaced condition means, scale points", sharesOfScale(options), {}, {}};
    group.tests = {{"repeated-measures ANOVA, Greenhouse-Geisser",
                    [=](const auto& d, double e) { return repeatedMeasuresPower(d, truth, spreadOf(d, e)); }, scale},
                   {"Friedman", [=](const auto& d, double e) { return friedmanPower(d, truth, spreadOf(d, e)); }, scale}};
    group.analysis = crossed(options.design, ratings(truth, evenlySpaced), [](const CrossedStudy& study, std::span<Value> p) {
        const BlockTable table = participantMeans(study);
        p[0] = repeatedMeasuresAnova(table).pGg;
        p[1] = friedmanTest(table).p;
    });
    return group;
}

PowerGroup allModelledConditions(const PowerOptions& options)
{
    const RatingTruth truth = options.ratings;
    PowerGroup group{
        "ratings", "range of evenly spaced condition means over all fabrics, scale points", sharesOfScale(options), {}, {}};
    group.tests = {{"mixed model, F of condition",
                    [=](const auto& d, double e) { return ratingModelPower(d, truth, spreadOf(d, e)); }, scaleOf(options)}};
    group.analysis = crossed(options.design, ratings(truth, evenlySpaced),
                             [](const CrossedStudy& study, std::span<Value> p) { p[0] = fitRatings(study).condition.p; });
    return group;
}

/// One-sided p of every condition.
std::vector<Value> againstChance(const CrossedStudy& study, double chance)
{
    std::vector<Value> p;
    const BlockTable blocks = answersByBlock(study);
    for (std::size_t c = 0; c < blocks.conditions; ++c) {
        const auto choices = blocks.column(c);
        const auto right = std::count(choices.begin(), choices.end(), 1.0);
        p.push_back(binomialTest(right, static_cast<long long>(choices.size()), chance).pGreater);
    }
    return p;
}

/// By formula, as if all choices of a condition were independent and equally likely to be right.
std::vector<GroupedTest> chanceTests(double chance)
{
    const auto power = [chance](const StudyDesign& d, double excess, double level) {
        return binomialPower({static_cast<long long>(d.participants * d.fabrics), chance, level}, std::min(1.0, chance + excess));
    };
    const auto powerOfShares = [chance](const StudyDesign& d, double excess) {
        const double p = std::min(1 - 1e-9, chance + excess);
        return tTestPower(static_cast<double>(d.participants), excess / std::sqrt(p * (1 - p) / static_cast<double>(d.fabrics)));
    };
    const double most = 1 - chance;
    return {{"exact binomial against chance", [=](const auto& d, double e) { return power(d, e, reportAlpha); }, most},
            {"the same after Holm over the conditions, the others at chance",
             [=](const auto& d, double e) { return power(d, e, reportAlpha / static_cast<double>(d.conditions)); }, most},
            {"t of participants' shares against chance", powerOfShares, most}};
}

PowerGroup oneConditionAboveChance(const PowerOptions& options)
{
    const double chance = 1.0 / options.design.alternatives;
    PowerGroup group{"choices", "share right above chance, one condition", {}, chanceTests(chance), {}};
    for (const double share : {0.15, 0.25, 0.4}) group.effects.push_back(share * (1 - chance));
    const Draw draw = [chance, truth = options.choices](CrossedStudy& study, double effect, Draws& draws) {
        std::vector<double> logOdds(study.condition.levels.size(), logOddsOf(chance));
        logOdds[0] = logOddsOf(chance + effect);
        drawChoices(study, truth, logOdds, draws);
    };
    group.analysis = crossed(options.design, draw, [chance](const CrossedStudy& study, std::span<Value> p) {
        const auto all = againstChance(study, chance);
        p[0] = all.front();
        p[1] = adjusted(all, Adjustment::Holm).front();
        p[2] = oneSampleTTest(participantMeans(study).column(0), {.mu = chance}).p;
    });
    return group;
}

PowerGroup allChoices(const PowerOptions& options)
{
    PowerGroup group{"choices", "range of evenly spaced log odds of a right choice, about even odds", {0.5, 1, 1.5}, {}, {}};
    group.tests = {{"logistic mixed model, likelihood ratio",
                    [](const auto& d, double e) { return choiceModelPower(d, 0.5, spreadOf(d, e)); }, largestLogOddsRange},
                   {"Cochran's Q", [](const auto&, double) { return Value::undefined("no formula is used; see the simulation"); },
                    largestLogOddsRange}};
    const Draw draw = [truth = options.choices](CrossedStudy& study, double effect, Draws& draws) {
        drawChoices(study, truth, evenlySpaced(study.condition.levels.size(), effect), draws);
    };
    group.analysis = crossed(options.design, draw, [](const CrossedStudy& study, std::span<Value> p) {
        p[0] = fitChoices(study).model.p;
        p[1] = cochranTest(answersByBlock(study)).p;
    });
    return group;
}

/// Generated against measured signals: the fabrics are the unit.
PowerGroup signals(const PowerOptions& options)
{
    PowerGroup group{"signals", "mean difference of generated and measured, SDs of the differences", {0.5, 1, 1.5}, {}, {}};
    group.tests = {{"paired t over fabrics",
                    [](const auto& d, double e) { return tTestPower(static_cast<double>(d.fabrics), e); }, largestStandardised}};
    group.analysis = [fabrics = options.design.fabrics](double effect, Draws& draws, std::span<Value> p) {
        std::vector<double> x(fabrics);
        for (double& value : x) value = effect + draws.normal();
        p[0] = pairedTTest(x, std::vector<double>(fabrics)).p;
    };
    return group;
}

}  // namespace

RatingTruth ofTheseFabrics(RatingTruth truth)
{
    truth.fabricCondition = 0;
    return truth;
}

std::vector<PowerGroup> powerGroups(const PowerOptions& options)
{
    const StudyDesign& design = options.design;
    std::vector<PowerGroup> groups;
    const bool compared = design.participants > 1 && design.conditions > 1;
    const bool severalFabrics = design.fabrics > 1;
    if (options.hasRatings && compared) {
        groups.push_back(oneDifference(options));
        groups.push_back(equivalence(options));
        if (severalFabrics) groups.push_back(oneModelledDifference(options));
        groups.push_back(allConditions(options));
        if (severalFabrics) groups.push_back(allModelledConditions(options));
    }
    if (options.hasChoices && design.participants > 1) groups.push_back(oneConditionAboveChance(options));
    if (options.hasChoices && compared && severalFabrics) groups.push_back(allChoices(options));
    if (severalFabrics) groups.push_back(signals(options));
    return groups;
}

}  // namespace stats
