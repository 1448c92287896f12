#include "stats/tests/one_way_anova.h"

#include <algorithm>
#include <cmath>

#include "stats/kernels/distributions.h"
#include "stats/kernels/exact_sum.h"
#include "stats/kernels/moments.h"

namespace stats {
namespace {

OneWayAnova& refuse(OneWayAnova& anova, const std::string& why)
{
    anova.why = why;
    for (Value* value : {&anova.ssBetween, &anova.ssWithin, &anova.msBetween, &anova.msWithin, &anova.df1, &anova.df2, &anova.f,
                         &anova.p, &anova.logP, &anova.rSquared, &anova.omegaSquared, &anova.residualSd})
        if (!value->exists()) *value = Value::undefined(why);
    return anova;
}

std::string faultOf(const std::vector<std::vector<double>>& groups, std::size_t n)
{
    if (groups.size() < 2) return "needs at least 2 groups";
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].empty()) return "group " + std::to_string(g + 1) + " is empty";
        if (std::string fault = nonFiniteFault(groups[g], "group " + std::to_string(g + 1)); !fault.empty()) return fault;
    }
    if (n <= groups.size()) return "needs more values than groups";
    return {};
}

/// Sum over the groups of n (mean - grand mean)^2, from differences of means, which keep their digits beside an offset.
double between(const std::vector<Moments>& groups, std::size_t n)
{
    double shift = groups.front().shift;
    for (const Moments& group : groups) shift = std::min(shift, group.shift);
    const auto distance = [&](std::size_t g) { return groups[g].meanMinus(shift); };
    const auto size = [&](std::size_t g) { return static_cast<double>(groups[g].n); };
    const double grand =
        orderFreeSum(groups.size(), [&](std::size_t g) { return size(g) * distance(g); }) / static_cast<double>(n);
    return orderFreeSum(groups.size(), [&](std::size_t g) {
        const double deviation = distance(g) - grand;
        return size(g) * deviation * deviation;
    });
}

}  // namespace

OneWayAnova oneWayAnova(const std::vector<std::vector<double>>& groups)
{
    OneWayAnova anova;
    anova.groups = groups.size();
    std::vector<double> all;
    for (const auto& group : groups) all.insert(all.end(), group.begin(), group.end());
    anova.n = all.size();
    if (const std::string fault = faultOf(groups, all.size()); !fault.empty()) return refuse(anova, fault);
    const ScaledSamples scaled({all});
    std::vector<Moments> moments;
    for (std::size_t g = 0, begin = 0; g < groups.size(); begin += groups[g].size(), ++g)
        moments.push_back(momentsOf(scaled.sample(0).subspan(begin, groups[g].size())));
    const double ssBetween = between(moments, all.size());
    const double ssWithin = orderFreeSum(moments.size(), [&](std::size_t g) { return moments[g].squares; });
    const auto df1 = static_cast<double>(groups.size() - 1);
    const auto df2 = static_cast<double>(all.size() - groups.size());
    const double msWithin = ssWithin / df2;
    anova.df1 = df1;
    anova.df2 = df2;
    anova.ssBetween = scaled.unscaledSquare(ssBetween);
    anova.ssWithin = scaled.unscaledSquare(ssWithin);
    anova.msBetween = scaled.unscaledSquare(ssBetween / df1);
    anova.msWithin = scaled.unscaledSquare(msWithin);
    anova.residualSd = scaled.unscaled(std::sqrt(msWithin));
    if (std::all_of(moments.begin(), moments.end(), isConstant)) return refuse(anova, "no variation within any group");
    anova.f = ssBetween / df1 / msWithin;
    const TailProbability tail = fisherUpper(*anova.f, df1, df2);
    anova.p = tail.p;
    anova.logP = tail.logP;
    anova.rSquared = ssBetween / (ssBetween + ssWithin);
    anova.omegaSquared = (ssBetween - df1 * msWithin) / (ssBetween + ssWithin + msWithin);
    return anova;
}

}  // namespace stats
