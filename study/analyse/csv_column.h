// One column of a CSV file (RFC 4180 with a header row). Empty, NA and NaN cells are missing values. Any other cell that is
// not a number is a fault that names its row.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace study::analyse {

/// The numbers of a column, NaN for missing ones. `note` gets a sentence where the file is no usual CSV (foreign_table.h). Throws
/// badInput, naming the file, the column or the row.
std::vector<double> readColumn(const std::filesystem::path& file, const std::string& column,
                               const std::function<void(const std::string& sentence)>& note = {});

/// The rows in which both columns have a number; `missing` counts the other rows.
struct PairedColumns {
    std::vector<double> a, b;
    std::size_t missing = 0;
};
PairedColumns completePairs(const std::vector<double>& a, const std::vector<double>& b);

/// The values that are not missing.
std::vector<double> present(const std::vector<double>& values);

}  // namespace study::analyse
