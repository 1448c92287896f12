#include "stats/tests/intraclass.h"

#include "stats/kernels/moments.h"
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

}  // namespace

IntraclassCorrelations intraclassCorrelations(const MeanSquares& ms, double targets, double raters)
{
    IntraclassCorrelations result;
    // What varies within a target when raters are not told apart.
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
    if (const std::string fault = twoWayFault(table); !fault.empty())
        return undefinedIcc(table.conditions < 2 ? "needs at least 2 raters"
                            : table.blocks < 2   ? "needs at least 2 targets"
                                                 : fault);
    const ScaledSamples scaled({table.values});
    const TwoWayEffects effects = twoWayEffects(scaled.sample(0), table);
    if (effects.isConstant()) return undefinedIcc("no variation: all values are equal");
    const auto n = static_cast<double>(table.blocks);
    const auto k = static_cast<double>(table.conditions);
    return intraclassCorrelations(
        {effects.ssBlock / (n - 1), effects.ssCondition / (k - 1), effects.ssResidual / ((n - 1) * (k - 1))}, n, k);
}

}  // namespace stats
