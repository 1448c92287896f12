// The friction part of dataset.h: records as CSV, whose header says what they are.
#include <algorithm>

#include "protocols/errors.h"
#include "rendering/fabrics/csv_table.h"
#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

namespace {

constexpr double leastNormalN = 0.05;  // below it a coefficient is noise over noise

std::string joined(const std::vector<std::string>& names)
{
    std::string line;
    for (const std::string& name : names) line += (line.empty() ? "" : ",") + name;
    return line;
}

protocols::Error unknownColumns(const CsvTable& table)
{
    return protocols::badInput({"has the columns " + joined(table.columns), table.where,
                                "t_s,normal_n,tangential_n or t_s,mu or t_s and one named quantity", ""});
}

std::vector<double> timesOf(const CsvTable& table, std::size_t column)
{
    std::vector<double> times;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        times.push_back(numberAt(table, row, column));
        if (row > 0 && times[row] <= times[row - 1])
            throw protocols::badInput(
                {"time does not increase", rowName(table, row) + ", column t_s", "rows in order of time", ""});
    }
    return times;
}

double coefficientAt(const CsvTable& table, std::size_t row, std::size_t normal, std::size_t tangential)
{
    const double force = numberAt(table, row, normal);
    if (force <= leastNormalN)
        throw protocols::badInput({"the normal force is " + shortest(force) + " N", rowName(table, row) + ", column normal_n",
                                   "more than 0.05 N: the probe must be in contact", "cut the record to the stroke"});
    return numberAt(table, row, tangential) / force;
}

}  // namespace

FrictionRecord readFriction(const Dataset& dataset, const protocols::FabricId& fabric, int index)
{
    const FabricInfo& info = dataset.fabric(fabric);
    const std::filesystem::path file = samplePath(dataset, fabric, Modality::Friction, index);
    if (!std::filesystem::exists(file))
        throw protocols::badInput(
            {"fabric " + fabric.value + " (" + info.name + ") has no friction sample " + std::to_string(index),
             dataset.folder.string(), "", "import friction records, or choose a condition that does not need them"});
    const CsvTable table = readCsvTable(file);
    const auto time = table.column("t_s");
    if (!time) throw unknownColumns(table);
    if (table.rows.size() < 2)
        throw protocols::badInput({"has " + std::to_string(table.rows.size()) + " rows", table.where, "at least 2", ""});
    FrictionRecord record;
    record.timeS = timesOf(table, *time);
    record.sampleRateHz = double(record.timeS.size() - 1) / (record.timeS.back() - record.timeS.front());
    record.speedMmPerS = dataset.friction.speedMmPerS;
    const auto normal = table.column("normal_n"), tangential = table.column("tangential_n");
    if (normal && tangential) {
        for (std::size_t row = 0; row < table.rows.size(); ++row)
            record.values.push_back(coefficientAt(table, row, *normal, *tangential));
        return record;
    }
    if (table.columns.size() != 2 || normal || tangential) throw unknownColumns(table);
    const std::size_t value = *time == 0 ? 1 : 0;
    record.quantity = table.columns[value];
    for (std::size_t row = 0; row < table.rows.size(); ++row) record.values.push_back(numberAt(table, row, value));
    return record;
}

}  // namespace rendering::fabrics
