// The rows of the data that have a value, scaled and checked for the mixed-model equations.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stats/models/mixed_model.h"

namespace stats {

/// Values are brought near 1 by powers of two. The least-squares fit of the fixed effects is subtracted from y, which
/// changes no variance and keeps digits.
struct MixedModelRows {
    std::string why;  ///< empty when a model can be fitted
    std::size_t missing = 0;
    int exponent = 0;  ///< y is scaled by 2^-exponent
    std::vector<double> y;
    FixedEffects fixed;
    std::vector<RandomTerm> random;
    std::vector<int> slopeExponents;
    std::vector<double> leastSquares;  ///< scaled estimates without random effects
    Matrix sequential;                 ///< MixedModel::sequential
};

/// True where values of a size near 1, from which their fit was subtracted, are rounding errors: the reason of a refusal.
bool isRoundingError(std::span<const double> y);
inline constexpr const char* noVariation = "the fixed effects reproduce every value: there is no variation left";

MixedModelRows mixedModelRows(const MixedModelData& data);

/// Whether two groups divide the rows in the same way, so that their variances cannot be separated.
bool divideAlike(const Factor& a, const Factor& b);
inline constexpr const char* sharedVariance =
    "another group divides the answers in the same way: only the sum of their variances is known";

/// Whether the fixed effects are those of a factor, and the values of one of its levels are all equal.
bool hasLevelOfEqualValues(const MixedModelData& data);

/// Level of each row, where the fixed effects are an intercept and the treatment coding of a factor; otherwise nothing.
std::optional<std::vector<std::size_t>> codedLevels(const FixedEffects& fixed);

}  // namespace stats
