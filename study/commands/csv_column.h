// One column of a CSV file (RFC 4180 with a header row): empty, NA and NaN cells are missing; anything
// else that is not a number is an error naming its row.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace study::commands {

/// Missing cells are NaN. Throws badInput naming the file, the column or the row.
std::vector<double> readColumn(const std::filesystem::path& file, const std::string& column);

/// Rows in which both columns have a number; `missing` counts the others.
struct PairedColumns {
    std::vector<double> a, b;
    std::size_t missing = 0;
};
PairedColumns completePairs(const std::vector<double>& a, const std::vector<double>& b);

/// Without the NaN.
std::vector<double> present(const std::vector<double>& values);

}  // namespace study::commands
