// Who, what and under which condition: a categorical variable of the rows of a data set, and the columns
// that its differences from a reference level make.
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

/// Levels in the order of first appearance.
Factor factorOf(std::string name, std::span<const std::string> values);

/// One level for each pair that occurs, in the order of first appearance; named "a:b".
Factor interactionOf(const Factor& a, const Factor& b);

/// Of the rows named; levels that no row has are left out, the others keep their order.
Factor rowsOf(const Factor& factor, std::span<const std::size_t> rows);

/// Fixed effects: named columns of one length.
struct FixedEffects {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;
};

/// An intercept, which is the mean of the first level, and one column for each further level: its
/// difference from the first (treatment coding). Names as in R: "(Intercept)", "conditionf".
FixedEffects treatmentCoded(const Factor& factor);

/// The intercept alone.
FixedEffects interceptOnly(std::size_t rows);

}  // namespace stats
