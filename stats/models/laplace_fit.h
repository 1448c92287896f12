// Maximises Laplace's approximation of the likelihood of choices with one log odds for each cell and crossed random
// intercepts. Deterministic.
#pragma once

#include <string>
#include <vector>

#include "stats/kernels/matrix.h"
#include "stats/models/factor.h"

namespace stats {

struct LaplaceFit {
    std::string why;            ///< empty when the maximum was found
    double criterion = 0;       ///< -2 log likelihood
    std::vector<double> sd;     ///< one for each group; 0 where the group was left out
    std::vector<double> means;  ///< log odds, one for each cell
    Matrix covariance;          ///< covariance of the means
    int evaluations = 0;
};

/// Where the curvature of the criterion is taken, which gives the standard errors.
enum class Curvature {
    AtOneStep,  ///< one Newton step from the mode of the random effects, as lme4 does
    AtTheMode,  ///< the mode follows the parameters, as in glmmTMB; larger by 0.1 to 0.5 %
};

/// Fits `right`, 0 or 1 in each row, where no cell is all right or all wrong. A group whose standard deviation is
/// estimated as zero is left out, and the rest is fitted again.
LaplaceFit laplaceFit(const std::vector<double>& right, const Factor& cells, const std::vector<Factor>& groups,
                      Curvature curvature = Curvature::AtOneStep);

}  // namespace stats
