// Factors of small studies in which every cell occurs once.
#pragma once

#include <string>
#include <vector>

#include "stats/models/factor.h"

/// A factor with the levels 1 to `levels`, each repeated `each` times, over `rows` rows.
inline stats::Factor cycled(const std::string& name, std::size_t levels, std::size_t each, std::size_t rows)
{
    std::vector<std::string> values;
    for (std::size_t row = 0; row < rows; ++row) values.push_back(std::to_string(row / each % levels + 1));
    return stats::factorOf(name, values);
}
