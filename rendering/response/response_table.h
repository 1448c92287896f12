// The table of a laboratory: grey level and friction, one row a measurement, in the order of the measurement. Separator, decimal
// mark and encoding are found (protocols/files/foreign).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rendering/response/response_fit.h"

namespace rendering {

struct ResponseTable {
    std::vector<FrictionAtLevel> measurements;
    double loadN = 0;   ///< median of the column, or the stated load
    std::string taken;  ///< what the file was taken for; empty where it is usual CSV
};

/// `columns`: names of columns by meaning: level, friction, force, load, sweep; others are found by usual names. A force needs a
/// load, from its column or `loadN`. Throws badInput with row and column: no such column, a level that is no whole number from 0
/// to 255, friction that is negative or above 10, no load or two.
ResponseTable readResponseTable(const std::filesystem::path& file, const std::map<std::string, std::string>& columns,
                                std::optional<double> loadN);

}  // namespace rendering
