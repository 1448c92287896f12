// How often each test of the report rejects when there is nothing to find, measured: studies are drawn
// from models in which the hypothesis is true and analysed by the very functions of the report.
#pragma once

#include <string>
#include <vector>

#include "stats/power/simulated_study.h"

namespace stats {

/// The level at which every test is tried.
inline constexpr double nominalAlpha = 0.05;

/// What is asked of a rate at nominalAlpha.
enum class Promise {
    Exact,    ///< 4.1 to 5.9 %: within four standard errors of 5 % in 10,000 studies
    AtMost,   ///< at most 5.9 %: exact and family-wise tests, whose size is attained below 5 %
    Printed,  ///< approximate tests: the rate is told, above 6 % it is flagged
    Shown,    ///< a test used where it must not be: told to show why the report does not
};

struct CalibrationRow {
    std::string test;
    std::string truth;  ///< what the studies were drawn from
    Promise promise = Promise::Printed;
    Rejections result;
    Value attainableSize;  ///< of exact tests, at alpha

    /// Above 6 %, and that not by chance: the interval of the rate lies above 5 %.
    bool antiConservative() const { return result.rate() > 0.06 && *result.interval().low > 0.05; }
    bool kept() const;            ///< the promise, where one was made
    std::string verdict() const;  ///< "kept", "broken", "anti-conservative", "" and why
};

struct CalibrationOptions {
    StudyDesign design;
    RatingTruth ratings;
    ChoiceTruth choices;
    SimulationOptions simulation;  ///< alpha stays 0.05
    std::size_t mixedModelStudies = 10000;
};

std::vector<CalibrationRow> calibration(const CalibrationOptions& options = {});

/// Simulated studies in all, for progress.
std::size_t calibrationStudies(const CalibrationOptions& options);

}  // namespace stats
