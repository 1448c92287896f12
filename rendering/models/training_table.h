// Named numbers by training step: the rows of a CSV file.
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
    std::map<int, std::vector<double>> rows;  ///< by step, in the order of `names`; NaN where there is none

    void put(int step, std::span<const NamedValue> values);
    void dropAfter(int step);
    std::vector<double> column(const std::string& name) const;  ///< empty for an unknown one
    bool operator==(const TrainingTable&) const = default;
};

/// Numbers in the shortest form that reads back; empty cells where there is none, "inf" and "-inf" as such.
std::string csvText(const TrainingTable& table);
TrainingTable readTrainingTable(const std::filesystem::path& file);  ///< a missing file is an empty table; throws badInput

/// A panel a column, losses first: the mean of neighbouring steps over their band, logarithmic where
/// positive values span more than a factor of thirty.
std::string curvesSvg(const TrainingTable& losses, const TrainingTable& validation);

}  // namespace rendering::models
