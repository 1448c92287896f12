#include "stats/claims/crossed_mean.h"

#include <algorithm>
#include <cmath>

#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/distributions.h"
#include "stats/models/mixed_model.h"

namespace stats {
namespace {

/// The rows that have a value.
CrossedValues withoutMissing(const CrossedValues& whole)
{
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < whole.values.size(); ++row)
        if (!std::isnan(whole.values[row])) rows.push_back(row);
    CrossedValues present{rowsOf(whole.participant, rows), rowsOf(whole.fabric, rows), {}};
    for (const std::size_t row : rows) present.values.push_back(whole.values[row]);
    return present;
}

/// Sums and counts of cells, averaged so that repetitions of a cell count once.
CrossedValues cellMeans(const CrossedValues& rows)
{
    const std::size_t fabrics = rows.fabric.levels.size();
    std::vector<double> sums(rows.participant.levels.size() * fabrics);
    std::vector<std::size_t> counts(sums.size());
    for (std::size_t row = 0; row < rows.values.size(); ++row) {
        const std::size_t cell = rows.participant.of[row] * fabrics + rows.fabric.of[row];
        sums[cell] += rows.values[row];
        ++counts[cell];
    }
    CrossedValues means{{rows.participant.name, rows.participant.levels, {}}, {rows.fabric.name, rows.fabric.levels, {}}, {}};
    for (std::size_t cell = 0; cell < sums.size(); ++cell) {
        if (counts[cell] == 0) continue;
        means.participant.of.push_back(cell / fabrics);
        means.fabric.of.push_back(cell % fabrics);
        means.values.push_back(sums[cell] / static_cast<double>(counts[cell]));
    }
    return means;
}

std::vector<double> meansOfParticipants(const CrossedValues& cells)
{
    std::vector<double> sums(cells.participant.levels.size());
    std::vector<std::size_t> counts(sums.size());
    for (std::size_t row = 0; row < cells.values.size(); ++row) {
        sums[cells.participant.of[row]] += cells.values[row];
        ++counts[cells.participant.of[row]];
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= static_cast<double>(counts[i]);
    return sums;
}

Interval intervalAround(double estimate, double se, double df, double confidence)
{
    const double reach = studentQuantile((1 - confidence) / 2, df) * se;
    return {estimate - reach, estimate + reach};
}

void refuse(CrossedMean& mean, const std::string& why)
{
    mean.why = why;
    const Value none = Value::undefined(why);
    mean.se = mean.df = none;
    mean.ci90 = mean.ci95 = {none, none};
}

void put(CrossedMean& mean, double estimate, double se, double df)
{
    mean.estimate = estimate;
    mean.se = se;
    mean.df = df;
    mean.ci90 = intervalAround(estimate, se, df, 0.90);
    mean.ci95 = intervalAround(estimate, se, df, 0.95);
}

void putParticipantsTest(CrossedMean& mean, const CrossedValues& cells)
{
    const TTest test = oneSampleTTest(meansOfParticipants(cells));
    mean.estimate = test.estimate;
    if (!test.why.empty()) return refuse(mean, test.why);
    put(mean, *test.estimate, *test.se, *test.df);
}

/// Upper limit of the degrees of freedom. Where a variance is estimated as zero, Satterthwaite's count the answers and not the
/// participants and fabrics. Far in the tails, where corrected tests decide, a test then rejects too often: 8.7 % of families of
/// 36 contrasts, with 7 fabrics of SD 0.5 and 10 participants. With this limit it is 5.5 %.
double mostDegrees(const CrossedMean& mean) { return 4.0 / 3.0 * static_cast<double>(mean.participants + mean.fabrics - 2); }

void putCrossedTest(CrossedMean& mean, const CrossedValues& cells)
{
    mean.estimate = meanOf(meansOfParticipants(cells));  // where the model gives none
    if (mean.fabrics < 2) return refuse(mean, "there is one fabric only: a result for fabrics like these needs at least 2");
    MixedModelData data{cells.values, interceptOnly(cells.values.size()), {}};
    for (const Factor& group : {cells.participant, cells.fabric})
        if (group.levels.size() < cells.values.size()) data.random.push_back({group, {}, ""});
    const MixedModel model = fitMixedModel(data);
    if (!model.why.empty()) return refuse(mean, model.why);
    const ContrastTest& test = model.fixed.front().test;
    if (!test.estimate.exists() || !test.se.exists() || !test.df.exists() || !(*test.df > 0))
        return refuse(mean, "the variation is beyond the range of double");
    mean.singular = model.singular;
    put(mean, *test.estimate, *test.se, std::min(*test.df, mostDegrees(mean)));
}

}  // namespace

CrossedMean crossedMean(const CrossedValues& values, Generalisation generalisation)
{
    const CrossedValues cells = cellMeans(withoutMissing(values));
    CrossedMean mean;
    mean.values = cells.values.size();
    mean.participants = cells.participant.levels.size();
    mean.fabrics = cells.fabric.levels.size();
    mean.estimate = Value::undefined("there are no values");
    if (mean.values == 0)
        refuse(mean, "there are no values");
    else if (std::all_of(cells.values.begin(), cells.values.end(), [&](double value) { return value == cells.values.front(); })) {
        mean.estimate = cells.values.front();
        refuse(mean, "all values are equal: how much others vary is unknown");
    } else if (mean.participants < 2)
        refuse(mean, "there is one participant only: a test needs at least 2");
    else if (generalisation == Generalisation::TheseFabrics)
        putParticipantsTest(mean, cells);
    else
        putCrossedTest(mean, cells);
    return mean;
}

CrossedMean crossedMean(const ContrastTest& contrast)
{
    CrossedMean mean;
    mean.estimate = contrast.estimate;
    if (contrast.estimate.exists() && contrast.se.exists() && contrast.df.exists())
        put(mean, *contrast.estimate, *contrast.se, *contrast.df);
    else
        refuse(mean, contrast.se.exists() ? contrast.df.why() : contrast.se.why());
    return mean;
}

MeanTest testOfMean(const CrossedMean& mean, double mu, Tail tail)
{
    if (!mean.why.empty()) {
        const Value none = Value::undefined(mean.why);
        return {none, none, none};
    }
    const double t = (*mean.estimate - mu) / *mean.se;
    const TailProbability p = tail == Tail::TwoSided  ? studentTwoSided(t, *mean.df)
                              : tail == Tail::Greater ? studentUpper(t, *mean.df)
                                                      : studentUpper(-t, *mean.df);
    return {t, p.p, p.logP};
}

MeanTest equivalenceOfMean(const CrossedMean& mean, double low, double high)
{
    const MeanTest aboveLow = testOfMean(mean, low, Tail::Greater), belowHigh = testOfMean(mean, high, Tail::Less);
    if (!aboveLow.p.exists()) return aboveLow;
    return *aboveLow.logP >= *belowHigh.logP ? aboveLow : belowHigh;
}

}  // namespace stats
