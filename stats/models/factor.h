// A categorical variable of the rows of a data set (participant, fabric, condition), and the columns that code its
// differences from a reference level.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace stats {

struct Factor {
    std::string name;
    std::vector<std::string> levels;
    std::vector<std::size_t> of;  ///< level of each row
};

/// A factor whose levels are in the order of first appearance.
Factor factorOf(std::string name, std::span<const std::string> values);

/// The interaction "a:b": one level for each pair that occurs, in the order of first appearance.
Factor interactionOf(const Factor& a, const Factor& b);

/// The factor of these rows only. Levels that no row has are left out; the others keep their order.
Factor rowsOf(const Factor& factor, std::span<const std::size_t> rows);

/// A factor of one level, "all".
Factor oneLevel(std::size_t rows);

/// Fixed effects: named columns of one length.
struct FixedEffects {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;
};

/// Treatment coding: an intercept, which is the mean of the first level, and one column for the difference of each
/// other level from it. Names as in R: "(Intercept)", "conditionf".
FixedEffects treatmentCoded(const Factor& factor);

/// The intercept only.
FixedEffects interceptOnly(std::size_t rows);

}  // namespace stats
