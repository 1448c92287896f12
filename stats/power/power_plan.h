// What a planned study can and cannot detect, before anyone is tested: each test that the report will
// run, with its power by formula where there is one and by simulation through the same analysis.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stats/power/simulated_study.h"

namespace stats {

struct PowerOptions {
    StudyDesign design;
    RatingTruth ratings;  ///< what is assumed about ratings; the deviations decide everything
    ChoiceTruth choices;
    bool hasRatings = true;
    bool hasChoices = true;
    std::pair<double, double> equivalenceBounds{-0.5, 0.5};
    SimulationOptions simulation{.studies = 1000};
};

struct PowerPoint {
    double effect = 0;
    Value power;  ///< by formula
    Rejections simulated;
    Value participants;  ///< needed for a power of 80 %, by formula
};

struct PlannedTest {
    std::string question;  ///< "ratings", "choices" or "signals"
    std::string test;
    std::string effect;        ///< what the effect is, with its unit
    Value smallestDetectable;  ///< with a power of 80 %, by formula, in the unit of `detectable`
    std::string detectable;    ///< the effect, unless said otherwise
    std::vector<PowerPoint> points;
};

/// A test that the design does not allow is absent.
std::vector<PlannedTest> plannedTests(const PowerOptions& options);

/// Simulated studies in all, for progress.
std::size_t plannedStudies(const PowerOptions& options);

}  // namespace stats
