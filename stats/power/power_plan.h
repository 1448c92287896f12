// What a planned study can detect: the power of each test of the report, by formula where there is one, and by
// simulation with the same analysis.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stats/power/simulated_study.h"

namespace stats {

struct PowerOptions {
    StudyDesign design;
    RatingTruth ratings;  ///< assumptions about ratings; their variances decide the power
    ChoiceTruth choices;
    bool hasRatings = true;
    bool hasChoices = true;
    std::pair<double, double> equivalenceBounds{-0.5, 0.5};
    SimulationOptions simulation{.studies = 1000};
    /// Counts that other processes made, one for each test and of `count` studies each; empty where these
    /// studies were not counted.
    std::function<std::vector<Rejections>(const std::string& studies, std::size_t count)> counted = {};
    /// Gets the counts as soon as they are finished.
    std::function<void(const std::string& studies, const std::vector<Rejections>& counts)> finished = {};
};

struct PowerPoint {
    double effect = 0;
    Value power;  ///< by formula
    Rejections simulated;
    Value participants;  ///< number needed for a power of 80 %, by formula
};

struct PlannedTest {
    std::string question;  ///< "ratings", "choices" or "signals"
    std::string test;
    std::string effect;        ///< name of the effect, with its unit
    Value smallestDetectable;  ///< smallest effect with a power of 80 %, by formula, in the unit of `detectable`
    std::string detectable;    ///< usually the same as `effect`
    std::vector<PowerPoint> points;
};

/// The narrowest bounds about 0 within which a true difference of 0 is shown equivalent in 80 % of studies, by TOST on
/// participants' means for these fabrics.
Value narrowestBounds(const PowerOptions& options);

/// The tests that the design allows.
std::vector<PlannedTest> plannedTests(const PowerOptions& options);

/// Number of simulated studies in all, for a progress display.
std::size_t plannedStudies(const PowerOptions& options);

}  // namespace stats
