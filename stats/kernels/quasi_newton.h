// Minimises a smooth function from its values and gradients by the BFGS method (Broyden, Fletcher, Goldfarb, Shanno).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "stats/kernels/matrix.h"

namespace stats {

struct PointOfFunction {
    bool exists = false;  ///< false where the function has no value: the search then shortens its step
    double value = 0;
    std::vector<double> gradient;
};
using SmoothFunction = std::function<PointOfFunction(std::span<const double>)>;

struct Minimum {
    std::string why;  ///< empty when a minimum was found
    std::vector<double> place;
    PointOfFunction at;
};

/// `inverseHessian`: a first guess. A bad guess costs steps, not accuracy.
Minimum minimised(const SmoothFunction& function, std::vector<double> start, Matrix inverseHessian);

/// Second derivatives by central differences of the gradient; empty where the function has no value nearby.
Matrix hessianOf(const SmoothFunction& function, std::span<const double> place);

}  // namespace stats
