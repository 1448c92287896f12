#include "study/commands/csv_column.h"

#include <cmath>
#include <limits>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"

namespace study::commands {

namespace {

bool isMissing(const std::string& cell)
{
    const auto first = cell.find_first_not_of(" \t");
    if (first == std::string::npos) return true;
    const auto text = cell.substr(first, cell.find_last_not_of(" \t") - first + 1);
    return text == "NA" || text == "NaN";
}

}  // namespace

std::vector<double> readColumn(const std::filesystem::path& file, const std::string& column)
{
    const auto table = protocols::readCsvTable(file);
    const auto index = table.column(column);
    if (!index) {
        std::string names;
        for (const auto& name : table.columns) names += (names.empty() ? "" : ", ") + name;
        throw protocols::badInput({"no column " + column, file.string(), "one of " + names, "check the spelling"});
    }
    std::vector<double> values;
    values.reserve(table.rows.size());
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        values.push_back(isMissing(table.rows[row][*index]) ? std::numeric_limits<double>::quiet_NaN()
                                                            : protocols::numberAt(table, row, *index));
    return values;
}

PairedColumns completePairs(const std::vector<double>& a, const std::vector<double>& b)
{
    PairedColumns pairs;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::isnan(a[i]) || std::isnan(b[i])) {
            ++pairs.missing;
            continue;
        }
        pairs.a.push_back(a[i]);
        pairs.b.push_back(b[i]);
    }
    return pairs;
}

std::vector<double> present(const std::vector<double>& values)
{
    std::vector<double> kept;
    for (double value : values)
        if (!std::isnan(value)) kept.push_back(value);
    return kept;
}

}  // namespace study::commands
