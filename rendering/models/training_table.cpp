#include "rendering/models/training_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace rendering::models {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string textOf(double value)
{
    if (std::isnan(value)) return "";
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::vector<std::string> cellsOf(const std::string& line)
{
    std::vector<std::string> cells(1);
    for (const char letter : line)
        if (letter == ',')
            cells.emplace_back();
        else
            cells.back() += letter;
    return cells;
}

template <class Number>
bool numberFrom(const std::string& cell, Number& value)
{
    const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return read.ec == std::errc() && read.ptr == cell.data() + cell.size();
}

protocols::Error notReadable(const std::filesystem::path& file, std::size_t line)
{
    return protocols::badInput({"is not a row of a training log", file.string() + ", line " + std::to_string(line),
                                "a step and its numbers",
                                "move the folder away; then the run continues without its earlier log"});
}

void readRow(TrainingTable& table, const std::string& line, const protocols::Error& fault)
{
    const std::vector<std::string> cells = cellsOf(line);
    int step = 0;
    if (cells.size() != table.names.size() + 1 || !numberFrom(cells.front(), step)) throw fault;
    std::vector<double> values(table.names.size(), none);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!cells[i + 1].empty() && !numberFrom(cells[i + 1], values[i])) throw fault;
    table.rows[step] = values;
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
    std::string text = "step";
    for (const std::string& name : table.names) text += "," + name;
    text += "\n";
    for (const auto& [step, row] : table.rows) {
        text += std::to_string(step);
        for (const double value : row) text += "," + textOf(value);
        text += "\n";
    }
    return text;
}

TrainingTable readTrainingTable(const std::filesystem::path& file)
{
    TrainingTable table;
    if (!std::filesystem::exists(file)) return table;
    const std::string text = readWholeFile(file);
    std::size_t line = 0;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        const std::string row = text.substr(from, end - from);
        from = end + 1;
        if (++line > 1) {
            readRow(table, row, notReadable(file, line));
            continue;
        }
        table.names = cellsOf(row);
        if (table.names.front() != "step") throw notReadable(file, line);
        table.names.erase(table.names.begin());
    }
    return table;
}

}  // namespace rendering::models
