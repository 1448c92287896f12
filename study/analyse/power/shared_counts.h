// The counts of `vis2hap power --shard`: what one process counted, and the sum over all of them. Counts are whole numbers, so the
// sum has the bits of a run in one process.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "stats/power/calibration.h"
#include "stats/power/planted_claims.h"
#include "stats/power/power_plan.h"

namespace study::analyse {

/// Counts by the name of the simulated studies.
struct SharedCounts {
    std::map<std::string, std::vector<stats::Rejections>> planned, calibrated;
    std::map<std::string, std::vector<stats::PlantedRow>> planted;

    /// Throws badInput, naming `where`, for counts of other studies or tests.
    void add(const SharedCounts& part, const std::string& where);
};

nlohmann::ordered_json jsonOf(const SharedCounts& counts);
/// Throws badInput, naming `where`, for other values than jsonOf() gives.
SharedCounts sharedCountsFrom(const nlohmann::ordered_json& values, const std::string& where);

/// Writes every count of a run into `counts`, which must outlive it; also those that the run takes from elsewhere.
void recordIn(SharedCounts& counts, stats::PowerOptions& options);
void recordIn(SharedCounts& counts, stats::CalibrationOptions& options);
void recordIn(SharedCounts& counts, stats::PlantedOptions& options);

/// Takes every count of a run from `counts`, which must outlive it. The run then throws badInput where one is missing or has
/// another number of studies.
void takeFrom(const SharedCounts& counts, stats::PowerOptions& options);
void takeFrom(const SharedCounts& counts, stats::CalibrationOptions& options);
void takeFrom(const SharedCounts& counts, stats::PlantedOptions& options);

}  // namespace study::analyse
