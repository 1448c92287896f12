#include "stats/tests/intraclass.h"

#include "stats/kernels/moments.h"
#include "stats/kernels/noncentral.h"
#include "stats/kernels/two_way.h"

namespace stats {
namespace {

Value ratio(double above, double below)
{
    return below == 0 ? Value::undefined("the targets do not differ") : Value(above / below);
}

IntraclassCorrelations undefinedIcc(const std::string& why)
{
    IntraclassCorrelations result;
    result.why = why;
    for (Value* value : {&result.icc1, &result.icc2, &result.icc3, &result.icc1k, &result.icc2k, &result.icc3k})
        *value = Value::undefined(why);
    return result;
}

IntraclassIntervals undefinedIntervals(const std::string& why)
{
    const Interval none{Value::undefined(why), Value::undefined(why)};
    return {why, none, none, none, none};
}

std::string faultOf(const BlockTable& table)
{
    if (table.conditions < 2) return "needs at least 2 raters";
    if (table.blocks < 2) return "needs at least 2 targets";
    return twoWayFault(table);
}

MeanSquares meanSquaresOf(const TwoWayEffects& effects)
{
    const double n = static_cast<double>(effects.blocks), k = static_cast<double>(effects.conditions);
    return {effects.ssBlock / (n - 1), effects.ssCondition / (k - 1), effects.ssResidual / ((n - 1) * (k - 1))};
}

/// Correlation of the mean of k raters, from that of one rater (Spearman and Brown).
Value ofTheMean(const Value& single, double k)
{
    if (!single.exists()) return single;
    const double below = 1 + *single * (k - 1);
    return below > 0 ? Value(*single * k / below) : Value::undefined("the limit for one rater is too far below zero");
}

/// Model 3, from the ratio F of the mean squares of targets and error.
Interval consistencyInterval(const MeanSquares& ms, double n, double k, double tail)
{
    const double f = ms.targets / ms.error, df1 = n - 1, df2 = (n - 1) * (k - 1);
    const double low = f / fisherQuantile(tail, df1, df2), high = f * fisherQuantile(tail, df2, df1);
    return {(low - 1) / (low + k - 1), (high - 1) / (high + k - 1)};
}

/// Model 2: Satterthwaite's degrees of freedom of the mean square that the targets are compared with.
Interval agreementInterval(const MeanSquares& ms, double icc, double n, double k, double tail)
{
    const double ratio = ms.raters / ms.error, ofTargets = n * (1 + (k - 1) * icc) - k * icc;
    const double sum = k * icc * ratio + ofTargets;
    const double df = (k - 1) * (n - 1) * sum * sum / ((n - 1) * k * k * icc * icc * ratio * ratio + ofTargets * ofTargets);
    if (!(df > 0)) {
        const Value none = Value::undefined("the approximate degrees of freedom are zero");
        return {none, none};
    }
    const double others = k * ms.raters + (k * n - k - n) * ms.error;
    const double above = fisherQuantile(tail, n - 1, df), below = fisherQuantile(tail, df, n - 1);
    return {n * (ms.targets - above * ms.error) / (above * others + n * ms.targets),
            n * (below * ms.targets - ms.error) / (others + n * below * ms.targets)};
}

}  // namespace

IntraclassIntervals intraclassIntervals(const BlockTable& table, double confidence)
{
    if (const std::string fault = faultOf(table); !fault.empty()) return undefinedIntervals(fault);
    const ScaledSamples scaled({table.values});
    const TwoWayEffects effects = twoWayEffects(scaled.sample(0), table);
    if (effects.isConstant()) return undefinedIntervals("no variation: all values are equal");
    if (effects.hasNoResiduals()) return undefinedIntervals("no error variance: the raters differ by constants only");
    const MeanSquares ms = meanSquaresOf(effects);
    const double n = static_cast<double>(table.blocks), k = static_cast<double>(table.conditions);
    const IntraclassCorrelations icc = intraclassCorrelations(ms, n, k);
    if (!icc.icc2.exists() || !icc.icc2k.exists() || !icc.icc3k.exists())
        return undefinedIntervals(icc.icc2.exists() ? icc.icc3k.why() : icc.icc2.why());
    const double tail = (1 - confidence) / 2;
    IntraclassIntervals result;
    result.icc2 = agreementInterval(ms, *icc.icc2, n, k, tail);
    result.icc3 = consistencyInterval(ms, n, k, tail);
    result.icc2k = {ofTheMean(result.icc2.low, k), ofTheMean(result.icc2.high, k)};
    result.icc3k = {ofTheMean(result.icc3.low, k), ofTheMean(result.icc3.high, k)};
    return result;
}

IntraclassCorrelations intraclassCorrelations(const MeanSquares& ms, double targets, double raters)
{
    IntraclassCorrelations result;
    // Mean square within targets, all raters taken together.
    const double within = (ms.raters + (targets - 1) * ms.error) / targets;
    const double raterShare = (ms.raters - ms.error) / targets;
    result.icc1 = ratio(ms.targets - within, ms.targets + (raters - 1) * within);
    result.icc2 = ratio(ms.targets - ms.error, ms.targets + (raters - 1) * ms.error + raters * raterShare);
    result.icc3 = ratio(ms.targets - ms.error, ms.targets + (raters - 1) * ms.error);
    result.icc1k = ratio(ms.targets - within, ms.targets);
    result.icc2k = ratio(ms.targets - ms.error, ms.targets + raterShare);
    result.icc3k = ratio(ms.targets - ms.error, ms.targets);
    return result;
}

IntraclassCorrelations intraclassCorrelations(const BlockTable& table)
{
    if (const std::string fault = faultOf(table); !fault.empty()) return undefinedIcc(fault);
    const ScaledSamples scaled({table.values});
    const TwoWayEffects effects = twoWayEffects(scaled.sample(0), table);
    if (effects.isConstant()) return undefinedIcc("no variation: all values are equal");
    return intraclassCorrelations(meanSquaresOf(effects), static_cast<double>(table.blocks),
                                  static_cast<double>(table.conditions));
}

}  // namespace stats
