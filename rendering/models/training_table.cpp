#include "rendering/models/training_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"

namespace rendering::models {

namespace {

/// Largest file of a training log, bytes: 400,000 steps of eight losses. A row of nothing but commas takes eight times its bytes.
constexpr std::uint64_t largestTrainingTable = std::uint64_t{1} << 26;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string textOf(double value) { return std::isnan(value) ? "" : protocols::shortest(value); }

template <class Number>
bool numberFrom(const std::string& cell, Number& value)
{
    const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return read.ec == std::errc() && read.ptr == cell.data() + cell.size();
}

protocols::Error notReadable(const std::string& place)
{
    return protocols::badInput({"is not a row of a training log", place, "a step and its numbers",
                                "move the folder away; then the run continues without its earlier log"});
}

void readRow(TrainingTable& table, const std::vector<std::string>& cells, const std::string& place)
{
    int step = 0;
    if (!numberFrom(cells.front(), step)) throw notReadable(place);
    std::vector<double> values(table.names.size(), none);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!cells[i + 1].empty() && !numberFrom(cells[i + 1], values[i])) throw notReadable(place);
    if (!table.rows.emplace(step, std::move(values)).second)
        throw protocols::badInput({"the step " + std::to_string(step) + " occurs twice", place, "each step once",
                                   "remove one of its two rows, or move the folder away"});
}

}  // namespace

void TrainingTable::put(int step, std::span<const NamedValue> values)
{
    for (const NamedValue& one : values)
        if (std::find(names.begin(), names.end(), one.name) == names.end()) {
            names.push_back(one.name);
            for (auto& [number, row] : rows) row.push_back(none);
        }
    std::vector<double>& row = rows[step];
    row.assign(names.size(), none);
    for (const NamedValue& one : values)
        row[static_cast<std::size_t>(std::find(names.begin(), names.end(), one.name) - names.begin())] = one.value;
}

void TrainingTable::dropAfter(int step) { rows.erase(rows.upper_bound(step), rows.end()); }

std::vector<double> TrainingTable::column(const std::string& name) const
{
    const auto found = std::find(names.begin(), names.end(), name);
    std::vector<double> values;
    if (found != names.end())
        for (const auto& [step, row] : rows) values.push_back(row[static_cast<std::size_t>(found - names.begin())]);
    return values;
}

std::string csvText(const TrainingTable& table)
{
    std::vector<std::string> cells{"step"};
    cells.insert(cells.end(), table.names.begin(), table.names.end());
    std::string text = protocols::csvRow(cells);
    for (const auto& [step, row] : table.rows) {
        cells.assign(1, std::to_string(step));
        for (const double value : row) cells.push_back(textOf(value));
        text += protocols::csvRow(cells);
    }
    return text;
}

TrainingTable readTrainingTable(const std::filesystem::path& file)
{
    TrainingTable table;
    if (!std::filesystem::exists(file)) return table;
    const std::string text = protocols::readWholeFile(file, largestTrainingTable);
    protocols::CsvReader reader(text, file.string());
    table.names = reader.columns();
    if (table.names.front() != "step") throw notReadable(file.string() + ", line 1");
    table.names.erase(table.names.begin());
    while (reader.next()) readRow(table, reader.cells(), reader.rowName());
    return table;
}

}  // namespace rendering::models
