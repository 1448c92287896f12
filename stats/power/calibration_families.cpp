#include "stats/power/calibration_families.h"

#include <algorithm>
#include <cmath>

#include "stats/power/power.h"
#include "stats/tests/binomial.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/mcnemar.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "stats/tests/sign_flip.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/wilcoxon.h"

namespace stats {
namespace {

constexpr double lowBound = -0.5;
constexpr double highBound = 0.5;
constexpr double narrowSd = 0.3;  // standard deviation of differences; the bounds are far apart for it

CalibrationRow row(std::string test, Promise promise, Value attainable = Value::undefined("not an exact test"))
{
    return {std::move(test), {}, promise, {}, std::move(attainable)};
}

Value smallest(const std::vector<Value>& p)
{
    Value least = Value::undefined("no test of the family exists");
    for (const Value& one : p)
        if (one.exists() && (!least.exists() || *one < *least)) least = one;
    return least;
}

/// Smallest Holm-adjusted p of all pairs of conditions: it is significant when any pair is.
Value leastOfAllPairs(const BlockTable& table)
{
    std::vector<Value> p;
    for (std::size_t a = 0; a < table.conditions; ++a)
        for (std::size_t b = a + 1; b < table.conditions; ++b) p.push_back(pairedTTest(table.column(a), table.column(b)).p);
    return smallest(adjusted(p, Adjustment::Holm));
}

/// Doubles the spread of every second condition about the common mean, so that the table is not spherical.
BlockTable unequallySpread(BlockTable table, double centre)
{
    for (std::size_t i = 0; i < table.values.size(); ++i)
        if (i % table.conditions % 2 == 1) table.values[i] = centre + 2 * (table.values[i] - centre);
    return table;
}

std::vector<double> shifted(std::vector<double> x, double by)
{
    for (double& value : x) value += by;
    return x;
}

/// Size of an exact test: the largest p up to nominalAlpha that differences without ties can have.
template <typename PValue>
Value attainableSize(std::size_t n, PValue pValue)
{
    double best = 0;
    std::vector<double> differences(n);
    for (std::size_t i = 0; i < n; ++i) differences[i] = static_cast<double>(i + 1);
    // Changing one or two signs goes through the rank sums from the most extreme one on.
    for (std::size_t i = 0; i < std::min<std::size_t>(n, 20); ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            auto x = differences;
            x[i] = -x[i];
            if (j < i) x[j] = -x[j];
            const Value p = pValue(x);
            if (p.exists() && *p <= nominalAlpha) best = std::max(best, *p);
        }
    return best > 0 ? Value(best) : Value::undefined("no result reaches alpha");
}

Value wilcoxonSize(std::size_t n)
{
    return attainableSize(n, [](const std::vector<double>& x) { return wilcoxonSignedRank(x, {}).pExact; });
}

CalibrationFamily equalRatings(const CalibrationOptions& options)
{
    CalibrationFamily family;
    family.truth = "ratings, all conditions alike for every fabric";
    const std::size_t n = options.design.participants;
    // All 2^n signs, two tails: multiples of 2 / 2^n.
    const double grain = std::ldexp(2.0, -static_cast<int>(n));
    family.tests = {row("paired t of participants' means", Promise::Exact),
                    row("Wilcoxon signed rank, exact", Promise::AtMost, wilcoxonSize(n)),
                    row("sign flips, exact", Promise::AtMost, grain * std::floor(nominalAlpha / grain)),
                    row("repeated-measures ANOVA, Greenhouse-Geisser", Promise::Printed),
                    row("the same, spread of the conditions 1 : 2", Promise::Printed),
                    row("Friedman, chi-squared", Promise::Printed),
                    row("Friedman, Iman-Davenport F", Promise::Printed),
                    row("any of all pairs, paired t after Holm", Promise::AtMost),
                    row("TOST at a bound, the design's own spread", Promise::AtMost)};
    RatingTruth truth = options.ratings;
    truth.fabricCondition = 0;
    const std::vector<double> means(options.design.conditions);
    const CrossedStudy empty = emptyStudy(options.design);
    family.analysis = [=](Draws& draws, std::span<Value> p) {
        CrossedStudy study = empty;
        drawRatings(study, truth, means, draws);
        const BlockTable table = participantMeans(study);
        const auto x = table.column(0);
        const auto y = table.column(1);
        const FriedmanTest friedman = friedmanTest(table);
        p[0] = pairedTTest(x, y).p;
        p[1] = wilcoxonSignedRank(x, y).pExact;
        p[2] = signFlipTest(x, y).p;
        p[3] = repeatedMeasuresAnova(table).pGg;
        p[4] = repeatedMeasuresAnova(unequallySpread(table, truth.centre)).pGg;
        p[5] = friedman.p;
        p[6] = friedman.fP;
        p[7] = leastOfAllPairs(table);
        p[8] = equivalenceTest(TKind::Paired, shifted(x, highBound), y, {lowBound, highBound, nominalAlpha}).p;
    };
    return family;
}

CalibrationFamily narrowDifferences(const CalibrationOptions& options)
{
    CalibrationFamily family;
    family.truth = "normal differences of SD 0.3 at a bound of +-0.5";
    family.tests = {row("TOST at a bound", Promise::Exact)};
    const std::size_t n = options.design.participants;
    family.analysis = [n](Draws& draws, std::span<Value> p) {
        std::vector<double> x(n);
        const std::vector<double> y(n);
        for (double& value : x) value = highBound + draws.normal(narrowSd);
        p[0] = equivalenceTest(TKind::Paired, x, y, {lowBound, highBound, nominalAlpha}).p;
    };
    return family;
}

CalibrationFamily sampledFabrics(const CalibrationOptions& options)
{
    CalibrationFamily family;
    family.truth = "ratings, conditions alike over all fabrics, each fabric having its own differences";
    family.tests = {row("mixed model, F of condition", Promise::Printed),
                    row("mixed model, t of one difference", Promise::Printed),
                    row("paired t of participants' means", Promise::Shown),
                    row("repeated-measures ANOVA, Greenhouse-Geisser", Promise::Shown)};
    const std::vector<double> means(options.design.conditions);
    const CrossedStudy empty = emptyStudy(options.design);
    family.analysis = [=, truth = options.ratings](Draws& draws, std::span<Value> p) {
        CrossedStudy study = empty;
        drawRatings(study, truth, means, draws);
        const BlockTable table = participantMeans(study);
        const RatingModel model = fitRatings(study);
        p[0] = model.condition.p;
        p[1] = levelDifference(model.model, 1, 0).p;
        p[2] = pairedTTest(table.column(0), table.column(1)).p;
        p[3] = repeatedMeasuresAnova(table).pGg;
    };
    return family;
}

Value binomialP(const BlockTable& blocks, std::size_t condition, double chance)
{
    const auto choices = blocks.column(condition);
    const auto right = std::count(choices.begin(), choices.end(), 1.0);
    return binomialTest(right, static_cast<long long>(choices.size()), chance).pGreater;
}

CalibrationFamily guesses(const CalibrationOptions& options)
{
    CalibrationFamily family;
    const double chance = 1.0 / options.design.alternatives;
    family.truth = "choices by guessing";
    const auto trials = static_cast<long long>(options.design.participants * options.design.fabrics);
    family.tests = {
        row("exact binomial against chance, one condition", Promise::AtMost, BinomialPlan{trials, chance, nominalAlpha}.size()),
        row("any condition, exact binomial after Holm", Promise::AtMost),
        row("t of participants' shares against chance, one condition", Promise::Printed),
        row("t of participants' shares against chance, all conditions", Promise::Printed)};
    const CrossedStudy empty = emptyStudy(options.design);
    family.analysis = [=](Draws& draws, std::span<Value> p) {
        CrossedStudy study = empty;
        for (double& value : study.values) value = draws.happens(chance) ? 1 : 0;
        const BlockTable blocks = answersByBlock(study);
        const BlockTable shares = participantMeans(study);
        std::vector<Value> all;
        for (std::size_t c = 0; c < blocks.conditions; ++c) all.push_back(binomialP(blocks, c, chance));
        std::vector<double> overall;
        for (std::size_t i = 0; i < shares.blocks; ++i) {
            double sum = 0;
            for (const double share : shares.row(i)) sum += share;
            overall.push_back(sum / static_cast<double>(shares.conditions));
        }
        p[0] = all[0];
        p[1] = smallest(adjusted(all, Adjustment::Holm));
        p[2] = oneSampleTTest(shares.column(0), {.mu = chance}).p;
        p[3] = oneSampleTTest(overall, {.mu = chance}).p;
    };
    return family;
}

Value mcNemarP(const BlockTable& blocks)
{
    long long onlyFirst = 0;
    long long onlySecond = 0;
    for (std::size_t i = 0; i < blocks.blocks; ++i) {
        onlyFirst += blocks.at(i, 0) > blocks.at(i, 1) ? 1 : 0;
        onlySecond += blocks.at(i, 0) < blocks.at(i, 1) ? 1 : 0;
    }
    return mcnemarTest(onlyFirst, onlySecond).pExact;
}

CalibrationFamily equalChoices(const CalibrationOptions& options)
{
    CalibrationFamily family;
    family.truth = "choices, all conditions alike, above chance, participants and fabrics differing";
    family.tests = {row("logistic mixed model, likelihood ratio", Promise::Printed), row("Cochran's Q", Promise::Printed),
                    row("McNemar, exact", Promise::AtMost), row("paired t of participants' shares", Promise::Printed)};
    const std::vector<double> logOdds(options.design.conditions, 0.5);
    const CrossedStudy empty = emptyStudy(options.design);
    family.analysis = [=, truth = options.choices](Draws& draws, std::span<Value> p) {
        CrossedStudy study = empty;
        drawChoices(study, truth, logOdds, draws);
        const BlockTable blocks = answersByBlock(study);
        const BlockTable shares = participantMeans(study);
        p[0] = fitChoices(study).model.p;
        p[1] = cochranTest(blocks).p;
        p[2] = mcNemarP(blocks);
        p[3] = pairedTTest(shares.column(0), shares.column(1)).p;
    };
    return family;
}

}  // namespace

std::vector<CalibrationFamily> calibrationFamilies(const CalibrationOptions& options)
{
    const StudyDesign& design = options.design;
    std::vector<CalibrationFamily> families;
    const auto add = [&](CalibrationFamily family, std::size_t studies) {
        family.studies = studies;
        families.push_back(std::move(family));
    };
    const bool compared = design.participants > 1 && design.conditions > 1;
    if (compared) add(equalRatings(options), options.simulation.studies);
    if (design.participants > 1) add(narrowDifferences(options), options.simulation.studies);
    if (design.participants > 1) add(guesses(options), options.simulation.studies);
    if (compared && design.fabrics > 1) add(sampledFabrics(options), options.mixedModelStudies);
    if (compared && design.fabrics > 1) add(equalChoices(options), options.mixedModelStudies);
    return families;
}

}  // namespace stats
