// The results of `vis2hap power`, as text on standard output and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "stats/power/calibration.h"
#include "stats/power/power_plan.h"

namespace study::analyse {

/// Adds "design", "assumed" and "simulation".
void putDesign(nlohmann::ordered_json& json, const stats::PowerOptions& options);
/// Adds "tests".
void putTests(nlohmann::ordered_json& json, const std::vector<stats::PlannedTest>& tests);
/// Adds "calibration".
void putCalibration(nlohmann::ordered_json& json, const std::vector<stats::CalibrationRow>& rows);

void printDesign(const std::string& protocol, const stats::PowerOptions& options);
void printTests(const std::vector<stats::PlannedTest>& tests);
void printCalibration(const std::vector<stats::CalibrationRow>& rows);

}  // namespace study::analyse
