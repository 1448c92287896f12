// Named numbers for each training step, as rows of a CSV file.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace rendering::models {

struct NamedValue {
    std::string name;  ///< no commas, quotes or line breaks
    double value = 0;
};

struct TrainingTable {
    std::vector<std::string> names;
    std::map<int, std::vector<double>> rows;  ///< for each step, in the order of `names`; NaN where a value is missing

    void put(int step, std::span<const NamedValue> values);
    void dropAfter(int step);
    std::vector<double> column(const std::string& name) const;  ///< empty for an unknown name
    bool operator==(const TrainingTable&) const = default;
};

/// Numbers in the shortest form that reads back exactly; empty cells for missing values, "inf" and "-inf" for infinite ones.
std::string csvText(const TrainingTable& table);
/// Empty for a missing file. Throws badInput for a malformed row, a step that occurs twice, and a file of more than 64 MiB.
TrainingTable readTrainingTable(const std::filesystem::path& file);

}  // namespace rendering::models
