// Maximises Laplace's approximation of the likelihood of ordered answers with one mean for each cell, thresholds and
// crossed random intercepts. Deterministic.
#pragma once

#include <string>
#include <vector>

#include "stats/kernels/matrix.h"
#include "stats/models/laplace_criterion.h"

namespace stats {

struct LaplaceFit {
    std::string why;                 ///< empty when the maximum was found
    double criterion = 0;            ///< -2 log likelihood
    std::vector<double> sd;          ///< one for each group; 0 where it was left out, NaN where it is not known alone
    std::vector<double> means;       ///< log odds of an answer above the anchor, one for each cell
    std::vector<double> thresholds;  ///< ascending; the anchor is 0. Two categories: {0}
    Matrix covariance;               ///< covariance of the means, then the thresholds; the anchor's row is 0
    int evaluations = 0;
};

/// Where the curvature of the criterion is taken, which gives the standard errors.
enum class Curvature {
    AtOneStep,  ///< one Newton step from the mode of the random effects, as lme4 does
    AtTheMode,  ///< the mode follows the parameters, as in glmmTMB; larger by 0.1 to 0.5 %
};

/// Multiplications of one step towards the mode of the random effects. Where they are more, the fit is refused with a reason:
/// it would take minutes.
inline constexpr double mostLaplaceCost = 1e8;

/// Fits answers where no cell has all answers in the lowest, or all in the highest category. A group whose standard deviation
/// is estimated as zero, or lies near zero and adds nothing to the likelihood, is left out, and the rest is fitted again. Of
/// groups that divide the answers in the same way only the sum of the variances is known. Few answers may have several maxima:
/// the best of two searches is taken.
LaplaceFit laplaceFit(const OrderedAnswers& answers, Curvature curvature = Curvature::AtOneStep);

}  // namespace stats
