// Friction records of a data set: CSV files whose header names the quantities.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

/// Record of one stroke: a coefficient of friction, or another quantity under its own name (never "mu").
struct FrictionRecord {
    std::string quantity = "mu";  ///< "mu" for the coefficient of friction, else a name such as "taxel_sum_counts"
    double sampleRateHz = 60;
    double speedMmPerS = 5;  ///< speed of the stroke: its own, else the data set's
    std::vector<double> timeS;
    std::vector<double> values;  ///< tangential over normal force, or the quantity
    bool isCoefficient() const { return quantity == "mu"; }
    double mean() const;  ///< of the values; at least one
};

/// N; below it the ratio of the forces is noise.
inline constexpr double leastNormalN = 0.05;

/// Shorter records contain no usable texture.
inline constexpr int shortestTrace = 8;

/// Longest step in time of one stroke, in median steps. A longer one is a jump of the clock, or rows are missing. Loggers write
/// bursts and pause, so that in a data set's record only a gap of more than a share of its duration counts.
inline constexpr double longestGapSteps = 10, longestGapShare = 0.01;

/// Sample rates of a record, Hz. Others come from time stamps in a wrong unit.
inline constexpr double leastRecordHz = 1e-3, mostRecordHz = 1e9;

/// Mean sample rate of the time stamps in Hz; at least two, rising. Throws badInput for a rate outside the limits above, and
/// for a gap longer than both `longestGapSteps` and `longestGapShare`. `where` names the record.
double meanRateHz(const std::vector<double>& timeS, const std::string& where);

/// The speed that the import's report beside a record states, mm/s: "speed_mm_per_s" in F01/friction/000.json for 000.csv.
/// Nullopt where there is no report or it states none. Throws badInput for a file that is no JSON, and for a speed that is no
/// number above 0 and below 1e9.
std::optional<double> ownSpeedMmPerS(const std::filesystem::path& record);

/// Throws badInput where a mean coefficient is not above 0. Below 0 the tangential axis points against the stroke, so that the
/// relief of h&f would be upside down.
void requireAxisAlongStroke(double meanCoefficient, const std::string& where);

/// "mu" for the usual names of a coefficient of friction in any case, such as "COF"; other names as they are. Records of one
/// quantity under two names would not share the range of their images.
std::string quantityNamed(const std::string& column);

/// Reads CSV with the columns t_s,normal_n,tangential_n, or t_s,mu, or t_s,<quantity>. Throws badInput, also where a row
/// has a normal force of at most `leastNormalN`, and where `meanRateHz` and `ownSpeedMmPerS` do.
FrictionRecord readFriction(const Dataset& dataset, const protocols::FabricId& fabric, int index);

}  // namespace rendering::fabrics
