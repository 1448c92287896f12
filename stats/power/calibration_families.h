// Families of simulated studies in which the null hypothesis is true, and the tests tried on each.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stats/power/calibration.h"

namespace stats {

struct CalibrationFamily {
    std::string truth;  ///< the model that the studies are drawn from
    std::vector<CalibrationRow> tests;
    SimulatedAnalysis analysis;
    std::size_t studies = 0;
};

/// The families that the design allows.
std::vector<CalibrationFamily> calibrationFamilies(const CalibrationOptions& options);

}  // namespace stats
