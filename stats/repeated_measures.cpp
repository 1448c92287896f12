#include "stats/repeated_measures.h"

#include <algorithm>
#include <cmath>

#include "stats/distributions.h"
#include "stats/exact_sum.h"
#include "stats/moments.h"

namespace stats {
namespace {

/// The table taken apart: grand mean + block effect + condition effect + residual, scaled near 1.
struct Effects {
    std::vector<double> block;
    std::vector<double> condition;
    std::vector<double> residual;  ///< row-major
    double largestResidual = 0;
    double ulp = 0;  ///< of the largest value: the grain of the inputs
};

double meanMinus(std::span<const double> x, double reference) { return momentsOf(x).meanMinus(reference); }

Effects effectsOf(std::span<const double> scaled, const BlockTable& shape)
{
    const std::size_t n = shape.blocks;
    const std::size_t k = shape.conditions;
    const Moments all = momentsOf(scaled);
    // Differences from a number near the mean are exact or nearly so; all later sums are small.
    std::vector<double> y(scaled.size());
    std::transform(scaled.begin(), scaled.end(), y.begin(), [&](double x) { return (x - all.shift) - all.residual; });
    Effects effects;
    effects.ulp = unitInLastPlace(std::max(std::fabs(all.smallest), std::fabs(all.largest)));
    effects.block.resize(n);
    effects.condition.resize(k);
    for (std::size_t i = 0; i < n; ++i) effects.block[i] = meanMinus(std::span(y).subspan(i * k, k), 0);
    for (std::size_t j = 0; j < k; ++j) {
        std::vector<double> column(n);
        for (std::size_t i = 0; i < n; ++i) column[i] = y[i * k + j] - effects.block[i];
        effects.condition[j] = meanMinus(column, 0);
    }
    effects.residual.resize(y.size());
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < k; ++j) {
            const double r = y[i * k + j] - effects.block[i] - effects.condition[j];
            effects.residual[i * k + j] = r;
            effects.largestResidual = std::max(effects.largestResidual, std::fabs(r));
        }
    return effects;
}

double sumOfSquares(std::span<const double> x)
{
    return exactSum(x.size(), [x](std::size_t i) { return x[i] * x[i]; });
}

/// tr(C)^2 / ((k-1) sum of C_ij^2), C being the double-centred covariance up to a factor.
double greenhouseGeisser(const Effects& effects, std::size_t n, std::size_t k)
{
    double trace = 0;
    double squares = 0;
    for (std::size_t a = 0; a < k; ++a)
        for (std::size_t b = 0; b < k; ++b) {
            const double c =
                exactSum(n, [&](std::size_t i) { return effects.residual[i * k + a] * effects.residual[i * k + b]; });
            squares += c * c;
            if (a == b) trace += c;
        }
    const double epsilon = trace * trace / (static_cast<double>(k - 1) * squares);
    return std::clamp(epsilon, 1 / static_cast<double>(k - 1), 1.0);
}

Value huynhFeldt(double epsilonGg, double n, double k)
{
    if (k == 2) return 1.0;
    const double denominator = (k - 1) * (n - 1 - (k - 1) * epsilonGg);
    if (denominator <= 0) return Value::undefined("too few blocks for the Huynh-Feldt correction");
    return (n * (k - 1) * epsilonGg - 2) / denominator;
}

void setIcc(RepeatedMeasuresAnova& anova, double msCondition, double msSubject, double msError, double n, double k)
{
    const auto ratio = [](double above, double below) {
        return below == 0 ? Value::undefined("no variance to share") : Value(above / below);
    };
    anova.icc2 = ratio(msCondition - msError, msCondition + (n - 1) * msError + n * (msSubject - msError) / k);
    anova.icc2k = ratio(msCondition - msError, msCondition + (msSubject - msError) / k);
    anova.icc3 = ratio(msCondition - msError, msCondition + (n - 1) * msError);
    anova.icc3k = ratio(msCondition - msError, msCondition);
}

void refuse(RepeatedMeasuresAnova& anova, const std::string& why)
{
    anova.why = why;
    for (Value* value :
         {&anova.ssCondition, &anova.ssSubject, &anova.ssError, &anova.f, &anova.df1, &anova.df2, &anova.p, &anova.logP,
          &anova.epsilonGg, &anova.pGg, &anova.logPGg, &anova.epsilonHf, &anova.pHf, &anova.partialEtaSquared,
          &anova.generalizedEtaSquared, &anova.icc2, &anova.icc2k, &anova.icc3, &anova.icc3k})
        if (!value->exists()) *value = Value::undefined(why);
}

std::string tableFault(const BlockTable& table)
{
    if (table.conditions < 2) return "needs at least 2 conditions";
    if (table.blocks < 2) return "needs at least 2 complete blocks";
    return nonFiniteFault(table.values, "the table");
}

void setTests(RepeatedMeasuresAnova& anova, double epsilonGg, double n, double k)
{
    const double df1 = k - 1;
    const double df2 = (k - 1) * (n - 1);
    const TailProbability plain = fisherUpper(*anova.f, df1, df2);
    const TailProbability corrected = fisherUpper(*anova.f, epsilonGg * df1, epsilonGg * df2);
    anova.df1 = df1;
    anova.df2 = df2;
    anova.p = plain.p;
    anova.logP = plain.logP;
    anova.epsilonGg = epsilonGg;
    anova.pGg = corrected.p;
    anova.logPGg = corrected.logP;
    anova.epsilonHf = huynhFeldt(epsilonGg, n, k);
    if (!anova.epsilonHf.exists()) {
        anova.pHf = anova.epsilonHf;
        return;
    }
    const double used = std::clamp(*anova.epsilonHf, epsilonGg, 1.0);
    anova.pHf = fisherUpper(*anova.f, used * df1, used * df2).p;
}

}  // namespace

std::vector<Value> moreyHalfWidths(const BlockTable& table, double confidence)
{
    if (const std::string fault = tableFault(table); !fault.empty())
        return std::vector<Value>(table.conditions, Value::undefined(fault));
    const ScaledSamples scaled({table.values});
    const Effects effects = effectsOf(scaled.sample(0), table);
    const auto n = static_cast<double>(table.blocks);
    const auto k = static_cast<double>(table.conditions);
    const double factor = studentQuantile((1 - confidence) / 2, n - 1) * std::sqrt(k / (k - 1) / n);
    std::vector<Value> result;
    for (std::size_t j = 0; j < table.conditions; ++j) {
        // Normalised values differ from the residuals by a constant per condition.
        const double squares = exactSum(table.blocks, [&](std::size_t i) {
            const double r = effects.residual[i * table.conditions + j];
            return r * r;
        });
        result.push_back(scaled.unscaled(factor * std::sqrt(squares / (n - 1))));
    }
    return result;
}

RepeatedMeasuresAnova repeatedMeasuresAnova(const BlockTable& table)
{
    RepeatedMeasuresAnova anova;
    anova.blocks = table.blocks;
    anova.moreyHalfWidths = moreyHalfWidths(table);
    if (const std::string fault = tableFault(table); !fault.empty()) {
        refuse(anova, fault);
        return anova;
    }
    const ScaledSamples scaled({table.values});
    const Effects effects = effectsOf(scaled.sample(0), table);
    const auto n = static_cast<double>(table.blocks);
    const auto k = static_cast<double>(table.conditions);
    const double condition = n * sumOfSquares(effects.condition);
    const double subject = k * sumOfSquares(effects.block);
    const double error = sumOfSquares(effects.residual);
    const auto squared = [&](double ss) { return Value(std::ldexp(ss, 2 * scaled.exponent())); };
    anova.ssCondition = squared(condition);
    anova.ssSubject = squared(subject);
    anova.ssError = squared(error);
    if (effects.largestResidual <= 4 * effects.ulp) {
        refuse(anova, "no error variance: the conditions differ by the same amounts in every block");
        return anova;
    }
    const double msCondition = condition / (k - 1);
    const double msError = error / ((k - 1) * (n - 1));
    anova.f = msCondition / msError;
    anova.partialEtaSquared = condition / (condition + error);
    anova.generalizedEtaSquared = condition / (condition + subject + error);
    setTests(anova, greenhouseGeisser(effects, table.blocks, table.conditions), n, k);
    setIcc(anova, msCondition, subject / (n - 1), msError, n, k);
    return anova;
}

}  // namespace stats
