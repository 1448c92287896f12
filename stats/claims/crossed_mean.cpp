#include "stats/claims/crossed_mean.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/distributions.h"
#include "stats/models/mixed_model.h"
#include "stats/models/mixed_model_fit.h"
#include "stats/models/mixed_model_rows.h"
#include "stats/tests/contrast.h"

namespace stats {
namespace {

constexpr const char* beyondRange = "the variation is beyond the range of double";

/// Means of the cells, so that repetitions of a cell count once.
CrossedTable cellMeans(const CrossedValues& rows)
{
    CrossedTable table{rows.participant.levels.size(), rows.fabric.levels.size(), {}};
    table.values.assign(table.participants * table.fabrics, 0);
    std::vector<std::size_t> counts(table.values.size());
    for (std::size_t row = 0; row < rows.values.size(); ++row) {
        if (std::isnan(rows.values[row])) continue;
        const std::size_t cell = rows.participant.of[row] * table.fabrics + rows.fabric.of[row];
        table.values[cell] += rows.values[row];
        ++counts[cell];
    }
    for (std::size_t cell = 0; cell < counts.size(); ++cell)
        table.values[cell] /= static_cast<double>(counts[cell]);  // 0 / 0: missing
    return table;
}

/// The participants and fabrics that have values. Nothing is copied where all have.
class Present {
public:
    explicit Present(const CrossedTable& whole) : m_table(&whole)
    {
        std::vector<std::size_t> participants, fabrics;
        std::vector<bool> met(whole.fabrics);
        for (std::size_t p = 0; p < whole.participants; ++p) {
            const std::size_t before = m_count;
            for (std::size_t f = 0; f < whole.fabrics; ++f) {
                if (std::isnan(whole.values[p * whole.fabrics + f])) continue;
                ++m_count;
                met[f] = true;
            }
            if (m_count > before) participants.push_back(p);
        }
        for (std::size_t f = 0; f < whole.fabrics; ++f)
            if (met[f]) fabrics.push_back(f);
        if (participants.size() == whole.participants && fabrics.size() == whole.fabrics) return;
        m_copy = {participants.size(), fabrics.size(), {}};
        for (const std::size_t p : participants)
            for (const std::size_t f : fabrics) m_copy.values.push_back(whole.values[p * whole.fabrics + f]);
        m_table = &m_copy;
    }
    Present(const Present&) = delete;
    Present& operator=(const Present&) = delete;

    const CrossedTable& table() const { return *m_table; }
    std::size_t count() const { return m_count; }
    bool isComplete() const { return m_count == m_table->values.size(); }

private:
    const CrossedTable* m_table;
    CrossedTable m_copy;
    std::size_t m_count = 0;
};

std::vector<double> meansOfParticipants(const CrossedTable& table)
{
    std::vector<double> means;
    for (std::size_t p = 0; p < table.participants; ++p) {
        double sum = 0;
        std::size_t count = 0;
        for (const double value : std::span(table.values).subspan(p * table.fabrics, table.fabrics)) {
            if (std::isnan(value)) continue;
            sum += value;
            ++count;
        }
        means.push_back(sum / static_cast<double>(count));
    }
    return means;
}

/// True where all values are equal.
bool isConstant(const CrossedTable& table)
{
    double first = std::nan("");
    for (const double value : table.values) {
        if (std::isnan(first)) first = value;
        if (!std::isnan(value) && value != first) return false;
    }
    return true;
}

void refuse(CrossedMean& mean, const std::string& why)
{
    mean.why = why;
    const Value none = Value::undefined(why);
    mean.se = mean.df = none;
    mean.ci90 = mean.ci95 = {none, none};
}

Interval intervalAround(double estimate, double reach) { return {estimate - reach, estimate + reach}; }

void put(CrossedMean& mean, double estimate, double se, double df, StudentQuantiles& quantiles)
{
    mean.estimate = estimate;
    mean.se = se;
    mean.df = df;
    mean.ci90 = intervalAround(estimate, quantiles.at((1 - 0.90) / 2, df) * se);
    mean.ci95 = intervalAround(estimate, quantiles.at((1 - 0.95) / 2, df) * se);
}

void putParticipantsTest(CrossedMean& mean, const CrossedTable& table, StudentQuantiles& quantiles)
{
    const std::vector<double> means = meansOfParticipants(table);
    if (const std::string fault = inputFault(TKind::OneSample, means, {}); !fault.empty()) {
        mean.estimate = Value::undefined(fault);
        return refuse(mean, fault);
    }
    const ScaledSamples scaled({means, std::span<const double>()});
    const Contrast contrast = contrastOf(TKind::OneSample, scaled);
    mean.estimate = scaled.unscaled(contrast.estimateMinus(0));
    if (!contrast.why.empty()) return refuse(mean, contrast.why);
    const Value se = scaled.unscaled(contrast.se);
    if (!mean.estimate.exists() || !se.exists()) return refuse(mean, beyondRange);
    put(mean, *mean.estimate, *se, contrast.df, quantiles);
}

/// Estimate of the mean; `why` is empty when it exists.
struct CrossedFit {
    std::string why;
    Value estimate, se, df;
    bool singular = false;
    bool noneVaries = false;  ///< both variances were estimated as zero
};

CrossedFit fitIncomplete(const CrossedTable& table)
{
    Factor participant{"participant", std::vector<std::string>(table.participants), {}},
        fabric{"fabric", std::vector<std::string>(table.fabrics), {}};
    MixedModelData data;
    for (std::size_t cell = 0; cell < table.values.size(); ++cell) {
        if (std::isnan(table.values[cell])) continue;
        data.y.push_back(table.values[cell]);
        participant.of.push_back(cell / table.fabrics);
        fabric.of.push_back(cell % table.fabrics);
    }
    data.fixed = interceptOnly(data.y.size());
    for (Factor* group : {&participant, &fabric})
        if (group->levels.size() < data.y.size()) data.random.push_back({std::move(*group), {}, ""});
    const MixedModel model = fitMixedModel(data);
    if (!model.why.empty()) return {model.why, {}, {}, {}};
    const ContrastTest& test = model.fixed.front().test;
    const bool noneVaries = std::ranges::all_of(model.random, [](const RandomEffect& effect) { return effect.zero; });
    return {"", test.estimate, test.se, test.df, model.singular, noneVaries};
}

/// Sum of squares of participants or fabrics; `size`: values of a level.
struct Effects {
    double squares, degrees, size;

    double meanSquare() const { return squares / degrees; }
};

/// Sums of squares of a complete table whose mean is 0.
struct TableSquares {
    Effects participant, fabric, residual;
};
TableSquares squaresOf(const std::vector<double>& y, std::size_t participants, std::size_t fabrics)
{
    const auto p = static_cast<double>(participants), f = static_cast<double>(fabrics);
    TableSquares result{{0, p - 1, f}, {0, f - 1, p}, {0, (p - 1) * (f - 1), 1}};
    std::vector<double> ofFabric(fabrics), ofParticipant(participants);
    for (std::size_t cell = 0; cell < y.size(); ++cell) {
        ofParticipant[cell / fabrics] += y[cell] / f;
        ofFabric[cell % fabrics] += y[cell] / p;
    }
    for (const double effect : ofParticipant) result.participant.squares += f * effect * effect;
    for (const double effect : ofFabric) result.fabric.squares += p * effect * effect;
    for (std::size_t cell = 0; cell < y.size(); ++cell) {
        const double rest = y[cell] - ofParticipant[cell / fabrics] - ofFabric[cell % fabrics];
        result.residual.squares += rest * rest;
    }
    return result;
}

/// Subtracts the mean and returns it; in two passes, as the first loses digits to a large offset.
double removeMean(std::vector<double>& y)
{
    double mean = 0;
    for (int pass = 0; pass < 2; ++pass) {
        double sum = 0;
        for (const double value : y) sum += value;
        const double more = sum / static_cast<double>(y.size());
        for (double& value : y) value -= more;
        mean += more;
    }
    return mean;
}

/// Whether a mean square of its own makes the levels no more likely than that of the residual: it is not larger, beyond what the
/// fit of a mixed model leaves of the criterion.
bool isNoLarger(const Effects& own, const Effects& residual)
{
    const double ratio = own.meanSquare() / residual.meanSquare();
    if (!(ratio > 1)) return !std::isnan(ratio);
    const double degrees = own.degrees + residual.degrees;
    return degrees * std::log((own.degrees * ratio + residual.degrees) / degrees) - own.degrees * std::log(ratio) <=
           criterionNoise;
}

/// Restricted maximum likelihood in closed form: a level varies as the residual does where its mean square is not larger.
CrossedFit fitComplete(const CrossedTable& table)
{
    double largest = 0;
    for (const double value : table.values) largest = std::max(largest, std::fabs(value));
    if (!std::isfinite(largest)) return {"a value is not finite", {}, {}, {}};
    const int exponent = std::ilogb(largest);
    std::vector<double> y;
    for (const double value : table.values) y.push_back(std::ldexp(value, -exponent));
    const double mean = removeMean(y);
    if (isRoundingError(y)) return {noVariation, {}, {}, {}};
    TableSquares squares = squaresOf(y, table.participants, table.fabrics);
    Effects& residual = squares.residual;
    std::vector<Effects*> varying{&squares.participant, &squares.fabric};
    if (squares.fabric.meanSquare() < squares.participant.meanSquare()) std::swap(varying[0], varying[1]);
    while (!varying.empty()) {  // the smallest first
        const Effects& least = *varying.front();
        if (!isNoLarger(least, residual)) break;
        residual.squares += least.squares;
        residual.degrees += least.degrees;
        varying.erase(varying.begin());
    }
    double variance = residual.meanSquare(), uncertainty = 0;
    for (const Effects* effects : varying) {
        const double excess = effects->meanSquare() - residual.meanSquare();
        if (!(excess < largestTheta * largestTheta * effects->size * residual.meanSquare())) return {noResidual, {}, {}, {}};
        variance += excess;
        uncertainty += effects->meanSquare() * effects->meanSquare() / effects->degrees;
    }
    // Where one of two varies, its mean square alone is the error of the mean.
    if (varying.size() != 1) uncertainty += residual.meanSquare() * residual.meanSquare() / residual.degrees;
    const double se = std::ldexp(std::sqrt(variance / static_cast<double>(y.size())), exponent);
    const bool inRange = std::isfinite(se) && se > 0;
    return {"",
            std::ldexp(mean, exponent),
            inRange ? Value(se) : Value::undefined(beyondRange),
            variance * variance / uncertainty,
            varying.size() < 2,
            varying.empty()};
}

void putCrossedTest(CrossedMean& mean, const Present& present, StudentQuantiles& quantiles, Degrees degrees)
{
    mean.estimate = meanOf(meansOfParticipants(present.table()));  // where the model gives none
    if (mean.fabrics < 2) return refuse(mean, "there is one fabric only: a result for fabrics like these needs at least 2");
    const CrossedFit fit = present.isComplete() ? fitComplete(present.table()) : fitIncomplete(present.table());
    if (!fit.why.empty()) return refuse(mean, fit.why);
    if (!fit.estimate.exists() || !fit.se.exists() || !fit.df.exists() || !(*fit.df > 0)) return refuse(mean, beyondRange);
    mean.singular = fit.singular;
    const double most = fit.noneVaries && degrees == Degrees::Limited ? mostDegrees(present.table()) : 0;
    const double df = most > 0 ? std::min(*fit.df, most) : *fit.df;  // 0 or no number: there is no residual to compare with
    put(mean, *fit.estimate, *fit.se, df, quantiles);
}

}  // namespace

double mostDegrees(const CrossedTable& whole)
{
    // Ratios of mean squares do not depend on the unit; squares of very large values would overflow.
    CrossedTable table = whole;
    double largest = 0;
    for (const double value : table.values)
        if (!std::isnan(value)) largest = std::max(largest, std::fabs(value));
    for (double& value : table.values) value = std::ldexp(value, -std::ilogb(largest));
    std::vector<double> ofParticipant(table.participants), ofFabric(table.fabrics), metByParticipant(table.participants),
        metByFabric(table.fabrics);
    double mean = 0, count = 0;
    for (std::size_t cell = 0; cell < table.values.size(); ++cell) {
        if (std::isnan(table.values[cell])) continue;
        mean += table.values[cell];
        ++count;
        ofParticipant[cell / table.fabrics] += table.values[cell];
        ++metByParticipant[cell / table.fabrics];
        ofFabric[cell % table.fabrics] += table.values[cell];
        ++metByFabric[cell % table.fabrics];
    }
    mean /= count;
    double participantSquares = 0, fabricSquares = 0, residualSquares = 0;
    for (std::size_t p = 0; p < table.participants; ++p) {
        ofParticipant[p] = ofParticipant[p] / metByParticipant[p] - mean;
        participantSquares += metByParticipant[p] * ofParticipant[p] * ofParticipant[p];
    }
    for (std::size_t f = 0; f < table.fabrics; ++f) {
        ofFabric[f] = ofFabric[f] / metByFabric[f] - mean;
        fabricSquares += metByFabric[f] * ofFabric[f] * ofFabric[f];
    }
    for (std::size_t cell = 0; cell < table.values.size(); ++cell) {
        if (std::isnan(table.values[cell])) continue;
        const double rest = table.values[cell] - mean - ofParticipant[cell / table.fabrics] - ofFabric[cell % table.fabrics];
        residualSquares += rest * rest;
    }
    const double participants = static_cast<double>(table.participants) - 1, fabrics = static_cast<double>(table.fabrics) - 1;
    const double residual = residualSquares / std::max(1.0, count - participants - fabrics - 1);
    const double sixthOfParticipants = std::pow(participantSquares / (participants * residual), 6),
                 sixthOfFabrics = std::pow(fabricSquares / (fabrics * residual), 6);
    return 1.2 / (sixthOfParticipants / participants + sixthOfFabrics / fabrics);
}

CrossedMean crossedMean(const CrossedValues& values, Generalisation generalisation)
{
    StudentQuantiles quantiles;
    return crossedMean(cellMeans(values), generalisation, quantiles);
}

CrossedMean crossedMean(const CrossedTable& table, Generalisation generalisation, StudentQuantiles& quantiles, Degrees degrees)
{
    const Present present(table);
    CrossedMean mean;
    mean.values = present.count();
    mean.participants = present.table().participants;
    mean.fabrics = present.table().fabrics;
    mean.estimate = Value::undefined("there are no values");
    if (mean.values == 0)
        refuse(mean, "there are no values");
    else if (isConstant(present.table())) {
        mean.estimate = *std::ranges::find_if(table.values, [](double value) { return !std::isnan(value); });
        refuse(mean, "all values are equal: how much others vary is unknown");
    } else if (mean.participants < 2) {
        mean.estimate = meanOf(meansOfParticipants(present.table()));
        refuse(mean, "there is one participant only: a test needs at least 2");
    } else if (generalisation == Generalisation::TheseFabrics)
        putParticipantsTest(mean, present.table(), quantiles);
    else
        putCrossedTest(mean, present, quantiles, degrees);
    return mean;
}

CrossedMean crossedMean(const ContrastTest& contrast)
{
    StudentQuantiles quantiles;
    return crossedMean(contrast, quantiles);
}

CrossedMean crossedMean(const ContrastTest& contrast, StudentQuantiles& quantiles)
{
    CrossedMean mean;
    mean.estimate = contrast.estimate;
    if (contrast.estimate.exists() && contrast.se.exists() && contrast.df.exists())
        put(mean, *contrast.estimate, *contrast.se, *contrast.df, quantiles);
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
    // The bound that is nearer has the larger p.
    if (!mean.why.empty() || *mean.estimate - low <= high - *mean.estimate) return testOfMean(mean, low, Tail::Greater);
    return testOfMean(mean, high, Tail::Less);
}

}  // namespace stats
