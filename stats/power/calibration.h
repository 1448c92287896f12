// Measured size of each test of the report: how often it rejects a true null hypothesis. Studies are drawn from models
// in which the hypothesis is true, and analysed by the functions that the report uses.
#pragma once

#include <string>
#include <vector>

#include "stats/power/simulated_study.h"

namespace stats {

/// The level at which every test is tried.
inline constexpr double nominalAlpha = 0.05;

/// Requirement on a rate at nominalAlpha.
enum class Promise {
    Exact,    ///< 4.1 to 5.9 %: within four standard errors of 5 % in 10,000 studies
    AtMost,   ///< at most 5.9 %: exact and family-wise tests, whose size lies below 5 %
    Printed,  ///< approximate tests: the rate is printed, and flagged above 6 %
    Shown,    ///< a test outside its assumptions: printed to show why the report does not use it
};

struct CalibrationRow {
    std::string test;
    std::string truth;  ///< the model that the studies were drawn from
    Promise promise = Promise::Printed;
    Rejections result;
    Value attainableSize;  ///< largest size of an exact test up to alpha

    /// True where the rate is above 6 % and its interval lies above 5 %.
    bool antiConservative() const { return result.rate() > 0.06 && *result.interval().low > 0.05; }
    bool kept() const;            ///< the rate fulfils its promise, where there is one
    std::string verdict() const;  ///< "kept", "broken", "anti-conservative" or ""
};

struct CalibrationOptions {
    StudyDesign design;
    RatingTruth ratings;
    ChoiceTruth choices;
    SimulationOptions simulation;  ///< alpha stays 0.05
    std::size_t mixedModelStudies = 10000;
    /// Counts of an earlier run that was interrupted, one for each test and of `studies` studies each; empty
    /// where this truth was not counted.
    std::function<std::vector<Rejections>(const std::string& truth, std::size_t studies)> counted = {};
    /// Gets the counts of a truth as soon as they are finished.
    std::function<void(const std::string& truth, const std::vector<Rejections>& counts)> finished = {};
};

std::vector<CalibrationRow> calibration(const CalibrationOptions& options = {});

/// The same for the claims of the report, under the nulls of claim_nulls.h, simulation.studies of each. Empty for a design with
/// one participant, fabric or condition.
std::vector<CalibrationRow> claimCalibration(const CalibrationOptions& options = {});

/// Number of simulated studies of both in all, for a progress display.
std::size_t calibrationStudies(const CalibrationOptions& options);

}  // namespace stats
