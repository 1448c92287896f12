// Minimises a smooth function from its values and gradients (Broyden, Fletcher, Goldfarb and Shanno).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "stats/kernels/matrix.h"

namespace stats {

struct PointOfFunction {
    bool exists = false;  ///< false: the function cannot be had there, the search steps back
    double value = 0;
    std::vector<double> gradient;
};
using SmoothFunction = std::function<PointOfFunction(std::span<const double>)>;

struct Minimum {
    std::string why;  ///< empty when one was found
    std::vector<double> place;
    PointOfFunction at;
};

/// `inverseHessian`: a guess that only costs steps where it is bad.
Minimum minimised(const SmoothFunction& function, std::vector<double> start, Matrix inverseHessian);

/// Second derivatives by central differences of the gradient; empty where a neighbour does not exist.
Matrix hessianOf(const SmoothFunction& function, std::span<const double> place);

}  // namespace stats
