// The rows of a mixed model's data that have a value, ready for the equations.
#pragma once

#include <string>
#include <vector>

#include "stats/models/mixed_model.h"

namespace stats {

/// Values are brought near 1 by powers of two; y is freed of what the fixed effects alone explain, which
/// changes no variance and keeps digits.
struct MixedModelRows {
    std::string why;  ///< empty when a model can be fitted
    std::size_t missing = 0;
    int exponent = 0;  ///< y is scaled by 2^-exponent
    std::vector<double> y;
    FixedEffects fixed;
    std::vector<RandomTerm> random;
    std::vector<int> slopeExponents;
    std::vector<double> leastSquares;  ///< estimates without random effects, scaled
    Matrix sequential;                 ///< MixedModel::sequential
};

MixedModelRows mixedModelRows(const MixedModelData& data);

}  // namespace stats
