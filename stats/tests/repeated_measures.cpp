#include "stats/tests/repeated_measures.h"

#include <algorithm>
#include <cmath>

#include "stats/kernels/distributions.h"
#include "stats/kernels/exact_sum.h"
#include "stats/kernels/moments.h"
#include "stats/kernels/two_way.h"
#include "stats/tests/intraclass.h"

namespace stats {
namespace {

/// Greenhouse and Geisser's epsilon, tr(C)^2 / ((k-1) sum of C_ij^2); C is the double-centred covariance up to a factor.
double greenhouseGeisser(const TwoWayEffects& effects)
{
    const std::size_t k = effects.conditions;
    double trace = 0;
    double squares = 0;
    for (std::size_t a = 0; a < k; ++a)
        for (std::size_t b = 0; b < k; ++b) {
            const double c =
                orderFreeSum(effects.blocks, [&](std::size_t i) { return effects.residualAt(i, a) * effects.residualAt(i, b); });
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
    if (denominator <= 1e-9 * (k - 1) * (n - 1)) return Value::undefined("too few blocks for the Huynh-Feldt correction");
    return (n * (k - 1) * epsilonGg - 2) / denominator;
}

/// Intraclass correlations with the conditions as targets and the blocks as raters.
void setIcc(RepeatedMeasuresAnova& anova, const MeanSquares& ms, double n, double k)
{
    const IntraclassCorrelations icc = intraclassCorrelations(ms, k, n);
    anova.icc2 = icc.icc2;
    anova.icc2k = icc.icc2k;
    anova.icc3 = icc.icc3;
    anova.icc3k = icc.icc3k;
}

void refuse(RepeatedMeasuresAnova& anova, const std::string& why)
{
    anova.why = why;
    anova.mauchly.why = why;
    for (Value* value : {&anova.ssCondition,
                         &anova.ssSubject,
                         &anova.ssError,
                         &anova.f,
                         &anova.df1,
                         &anova.df2,
                         &anova.p,
                         &anova.logP,
                         &anova.epsilonGg,
                         &anova.pGg,
                         &anova.logPGg,
                         &anova.epsilonHf,
                         &anova.pHf,
                         &anova.logPHf,
                         &anova.partialEtaSquared,
                         &anova.generalizedEtaSquared,
                         &anova.icc2,
                         &anova.icc2k,
                         &anova.icc3,
                         &anova.icc3k,
                         &anova.mauchly.w,
                         &anova.mauchly.chiSquared,
                         &anova.mauchly.df,
                         &anova.mauchly.pChiSquared,
                         &anova.mauchly.pSecondOrder})
        if (!value->exists()) *value = Value::undefined(why);
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
        anova.pHf = anova.logPHf = anova.epsilonHf;
        return;
    }
    const double used = std::clamp(*anova.epsilonHf, epsilonGg, 1.0);
    const TailProbability huynhFeldtTail = fisherUpper(*anova.f, used * df1, used * df2);
    anova.pHf = huynhFeldtTail.p;
    anova.logPHf = huynhFeldtTail.logP;
}

}  // namespace

std::vector<Value> moreyHalfWidths(const BlockTable& table, double confidence)
{
    if (const std::string fault = twoWayFault(table); !fault.empty())
        return std::vector<Value>(table.conditions, Value::undefined(fault));
    const ScaledSamples scaled({table.values});
    const TwoWayEffects effects = twoWayEffects(scaled.sample(0), table);
    const auto n = static_cast<double>(table.blocks);
    const auto k = static_cast<double>(table.conditions);
    const double factor = studentQuantile((1 - confidence) / 2, n - 1) * std::sqrt(k / (k - 1) / n);
    std::vector<Value> result;
    for (std::size_t j = 0; j < table.conditions; ++j) {
        // Within a condition, normalised values and residuals differ by a constant only.
        const double squares =
            orderFreeSum(table.blocks, [&](std::size_t i) { return effects.residualAt(i, j) * effects.residualAt(i, j); });
        result.push_back(scaled.unscaled(factor * std::sqrt(squares / (n - 1))));
    }
    return result;
}

RepeatedMeasuresAnova repeatedMeasuresAnova(const BlockTable& table)
{
    RepeatedMeasuresAnova anova;
    anova.blocks = table.blocks;
    anova.moreyHalfWidths = moreyHalfWidths(table);
    if (const std::string fault = twoWayFault(table); !fault.empty()) {
        refuse(anova, fault);
        return anova;
    }
    const ScaledSamples scaled({table.values});
    const TwoWayEffects effects = twoWayEffects(scaled.sample(0), table);
    const auto n = static_cast<double>(table.blocks);
    const auto k = static_cast<double>(table.conditions);
    anova.ssCondition = scaled.unscaledSquare(effects.ssCondition);
    anova.ssSubject = scaled.unscaledSquare(effects.ssBlock);
    anova.ssError = scaled.unscaledSquare(effects.ssResidual);
    if (effects.hasNoResiduals()) {
        refuse(anova, "no error variance: the conditions differ by the same amounts in every block");
        return anova;
    }
    const MeanSquares ms{effects.ssCondition / (k - 1), effects.ssBlock / (n - 1), effects.ssResidual / ((k - 1) * (n - 1))};
    anova.f = ms.targets / ms.error;
    anova.partialEtaSquared = effects.ssCondition / (effects.ssCondition + effects.ssResidual);
    anova.generalizedEtaSquared = effects.ssCondition / (effects.ssCondition + effects.ssBlock + effects.ssResidual);
    anova.mauchly = mauchlyTest(effects);
    setTests(anova, greenhouseGeisser(effects), n, k);
    setIcc(anova, ms, n, k);
    return anova;
}

}  // namespace stats
