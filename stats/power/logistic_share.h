// The share of right choices of a logistic model whose log odds vary normally.
#pragma once

namespace stats {

/// 1 / (1 + e^-x).
double shareOfLogOdds(double x);

/// Mean of shareOfLogOdds(intercept + a normal deviation of this SD), by the trapezoidal rule.
double meanShare(double intercept, double sd);

/// The intercept at which the share is `share` on average over normal deviations of this SD. 0 < share < 1.
double interceptFor(double share, double sd);

}  // namespace stats
