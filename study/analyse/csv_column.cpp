#include "study/analyse/csv_column.h"

#include <cmath>
#include <limits>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"

namespace study::analyse {

std::vector<double> readColumn(const std::filesystem::path& file, const std::string& column,
                               const std::function<void(const std::string& sentence)>& note)
{
    const auto foreign = protocols::readForeignTable(file);
    if (note && !foreign.isUsual) note(file.string() + ": read with " + foreign.taken);
    const protocols::CsvTable& table = foreign.table;
    const auto index = table.column(column);
    if (!index) {
        std::string names;
        for (const auto& name : table.columns) names += (names.empty() ? "" : ", ") + name;
        throw protocols::badInput({"there is no column " + column, file.string(), "one of " + names, "check the spelling"});
    }
    std::vector<double> values;
    values.reserve(table.rows.size());
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        values.push_back(protocols::numberOrMissing(table, row, *index).value_or(std::numeric_limits<double>::quiet_NaN()));
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

}  // namespace study::analyse
