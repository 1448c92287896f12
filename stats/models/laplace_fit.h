// The maximum of Laplace's approximation for choices with one log odds a cell and crossed random
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
    std::vector<double> sd;     ///< by group; 0 where it was left out
    std::vector<double> means;  ///< log odds of each cell
    Matrix covariance;          ///< of the means
    int evaluations = 0;
};

/// `right`: 0 or 1 a row; no cell all right or all wrong. Groups whose standard deviation is estimated as
/// zero are left out and the rest is fitted again.
LaplaceFit laplaceFit(const std::vector<double>& right, const Factor& cells, const std::vector<Factor>& groups);

}  // namespace stats
