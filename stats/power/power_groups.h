// The tests of the report, grouped by the simulated studies that they share.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stats/power/power_plan.h"

namespace stats {

/// Power of a test for a design and an effect; undefined where there is no formula.
using PowerFormula = std::function<Value(const StudyDesign& design, double effect)>;

struct GroupedTest {
    std::string name;
    PowerFormula formula;
    double most = 0;  ///< largest possible effect; 0 for an equivalence test
};

struct PowerGroup {
    std::string question;
    std::string effect;  ///< name of the effect, with its unit
    std::vector<double> effects;
    std::vector<GroupedTest> tests;
    /// Draws a study with that effect and stores the p of each test.
    std::function<void(double effect, Draws& draws, std::span<Value> p)> analysis;
};

/// The groups that the design allows.
std::vector<PowerGroup> powerGroups(const PowerOptions& options);

/// The same truth without random differences between fabrics, for tests about these fabrics only.
RatingTruth ofTheseFabrics(RatingTruth truth);

}  // namespace stats
