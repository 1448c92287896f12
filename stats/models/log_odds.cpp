#include "stats/models/log_odds.h"

#include <algorithm>
#include <cmath>

#include "stats/kernels/distributions.h"

namespace stats {

LogOdds logOddsOf(const std::string& name, double estimate, double variance, double confidence)
{
    const double se = std::sqrt(variance);
    const TailProbability p = twice(normalUpper(std::fabs(estimate / se)));
    const double reach = normalQuantile((1 - confidence) / 2) * se;
    return {name, estimate, se, estimate / se, p.p, p.logP, {estimate - reach, estimate + reach}};
}

LogOdds undefinedLogOdds(const std::string& name, const std::string& why)
{
    const Value none = Value::undefined(why);
    return {name, none, none, none, none, none, {none, none}};
}

LikelihoodRatio likelihoodRatioOf(double criterion, double criterionNull, std::size_t df)
{
    const double chiSquared = std::max(0.0, criterionNull - criterion);
    const TailProbability tail = chiSquaredUpper(chiSquared, static_cast<double>(df));
    return {chiSquared, static_cast<double>(df), tail.p, tail.logP};
}

}  // namespace stats
