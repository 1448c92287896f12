#include "rendering/fabrics/friction_record.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"

namespace rendering::fabrics {

namespace {

std::string headerLine(const std::vector<std::string>& names)
{
    std::string line;
    for (const std::string& name : names) line += (line.empty() ? "" : ",") + name;
    return line;
}

protocols::Error unknownColumns(const protocols::CsvReader& reader)
{
    return protocols::badInput({"has the columns " + headerLine(reader.columns()), reader.where(),
                                "t_s,normal_n,tangential_n or t_s,mu or t_s and one named quantity", "rename the columns"});
}

void addTime(FrictionRecord& record, const protocols::CsvReader& reader, std::size_t column)
{
    const double time = reader.number(column);
    if (!record.timeS.empty() && !(time > record.timeS.back()))
        throw protocols::badInput(
            {"time does not increase", reader.rowName() + ", column t_s", "rows in order of time", "cut or sort the record"});
    record.timeS.push_back(time);
}

double coefficientIn(const protocols::CsvReader& reader, std::size_t normal, std::size_t tangential)
{
    const double force = reader.number(normal);
    if (force <= leastNormalN)
        throw protocols::badInput({"the normal force is " + protocols::shortest(force) + " N",
                                   reader.rowName() + ", column normal_n", "more than 0.05 N, so that the probe is in contact",
                                   "cut the record to the stroke"});
    const double coefficient = reader.number(tangential) / force;
    if (!std::isfinite(coefficient))
        throw protocols::badInput(
            {"the forces have no finite ratio", reader.rowName(), "finite forces in N", "correct the row or remove it"});
    return coefficient;
}

/// The number with at most four digits: "0.01", "3600".
std::string fourDigitsOf(double value)
{
    char text[40];
    const auto [end, problem] = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4);
    return std::string(text, problem == std::errc{} ? end : text);
}

/// A jump of the clock spoils the rate, so that this is asked first.
void requireOneStroke(const std::vector<double>& timeS, const std::string& where)
{
    std::vector<double> steps;
    steps.reserve(timeS.size());
    for (std::size_t i = 1; i < timeS.size(); ++i) steps.push_back(timeS[i] - timeS[i - 1]);
    const auto longest = std::max_element(steps.begin(), steps.end());
    const double gapS = *longest;
    const auto row = longest - steps.begin() + 2;
    const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    const double mostS = std::max(longestGapSteps * *middle, longestGapShare * (timeS.back() - timeS.front()));
    if (gapS > mostS)
        throw protocols::badInput({"has a gap in time of " + fourDigitsOf(gapS) + " s", where + ", row " + std::to_string(row),
                                   "steps of at most " + fourDigitsOf(mostS) + " s, as in one stroke",
                                   "cut the record to the stroke or correct its clock, or use `vis2hap import friction-csv`"});
}

}  // namespace

double FrictionRecord::mean() const
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void requireAxisAlongStroke(double meanCoefficient, const std::string& where)
{
    if (meanCoefficient > 0) return;
    const bool isAgainst = meanCoefficient < 0;
    throw protocols::badInput({"the mean coefficient of friction is " + fourDigitsOf(meanCoefficient) +
                                   (isAgainst ? ", so the tangential axis points against the stroke" : ""),
                               where, "a mean above 0",
                               isAgainst ? "negate the tangential force, or import the record again with --tangential=-NAME"
                                         : "check that the tangential force was recorded"});
}

double meanRateHz(const std::vector<double>& timeS, const std::string& where)
{
    requireOneStroke(timeS, where);
    const double rateHz = double(timeS.size() - 1) / (timeS.back() - timeS.front());
    if (!(rateHz >= leastRecordHz && rateHz <= mostRecordHz))
        throw protocols::badInput({"the time stamps give a sample rate of " + fourDigitsOf(rateHz) + " Hz", where,
                                   "a rate from 0.001 to 1e9 Hz", "check that the column t_s is in seconds"});
    return rateHz;
}

std::optional<double> ownSpeedMmPerS(const std::filesystem::path& record)
{
    constexpr double limitMmPerS = 1e9;  // as in dataset.json
    std::filesystem::path file = record;
    file.replace_extension(".json");
    if (!std::filesystem::exists(file)) return std::nullopt;
    const auto report = protocols::parseStrictJson(protocols::readWholeFile(file, protocols::largestJson), file.string());
    if (!report.is_object() || report.value("schema", nlohmann::json()) != "vis2hap.friction-import/1") return std::nullopt;
    const nlohmann::json speed = report.value("speed_mm_per_s", nlohmann::json());
    if (speed.is_null()) return std::nullopt;
    if (!speed.is_number() || !(speed.get<double>() > 0) || !(speed.get<double>() < limitMmPerS))
        throw protocols::badInput({"\"speed_mm_per_s\" is " + speed.dump(), file.string(),
                                   "a number above 0 and below 1e9, or null", "correct the file"});
    return speed.get<double>();
}

std::string quantityNamed(const std::string& column)
{
    std::string lower = column;
    for (char& letter : lower)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    for (const char* name : {"mu", "cof", "friction_coefficient", "coefficient_of_friction"})
        if (lower == name) return "mu";
    return column;
}

FrictionRecord readFriction(const Dataset& dataset, const protocols::FabricId& fabric, int index)
{
    const FabricInfo& info = dataset.fabric(fabric);
    const std::filesystem::path file = samplePath(dataset, fabric, Modality::Friction, index);
    if (!std::filesystem::exists(file))
        throw protocols::badInput(
            {"fabric " + fabric.value + " (" + info.name + ") has no friction sample " + std::to_string(index),
             dataset.folder.string(), "an existing sample",
             "import friction records, or choose a condition that does not need them"});
    const std::string bytes = protocols::readWholeFile(file);
    protocols::CsvReader reader(bytes, file.string());
    const auto time = reader.column("t_s"), normal = reader.column("normal_n"), tangential = reader.column("tangential_n");
    const bool forces = normal && tangential;
    if (!time || (!forces && (reader.columns().size() != 2 || normal || tangential))) throw unknownColumns(reader);
    const std::size_t value = *time == 0 ? 1 : 0;
    FrictionRecord record;
    if (!forces) record.quantity = quantityNamed(reader.columns()[value]);
    while (reader.next()) {
        addTime(record, reader, *time);
        record.values.push_back(forces ? coefficientIn(reader, *normal, *tangential) : reader.number(value));
    }
    if (record.values.size() < 2)
        throw protocols::badInput({"has " + std::to_string(record.values.size()) + " rows", reader.where(), "at least 2 rows",
                                   "check that the record is complete"});
    record.sampleRateHz = meanRateHz(record.timeS, file.string());
    record.speedMmPerS = ownSpeedMmPerS(file).value_or(dataset.friction.speedMmPerS);
    return record;
}

}  // namespace rendering::fabrics
