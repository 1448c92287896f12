// The tests of the report, grouped by the simulated studies that they can share.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stats/power/power_plan.h"

namespace stats {

/// Power of a design at an effect; undefined where no formula is used.
using PowerFormula = std::function<Value(const StudyDesign& design, double effect)>;

struct GroupedTest {
    std::string name;
    PowerFormula formula;
    double most = 0;  ///< the largest effect there is; 0: the test shows that there is none (equivalence)
};

struct PowerGroup {
    std::string question;
    std::string effect;  ///< what it is, with its unit
    std::vector<double> effects;
    std::vector<GroupedTest> tests;
    /// Draws a study with that effect and puts the tests' p values in their places.
    std::function<void(double effect, Draws& draws, std::span<Value> p)> analysis;
};

/// Those that the design allows.
std::vector<PowerGroup> powerGroups(const PowerOptions& options);

/// The same truth without differences that belong to single fabrics: what a test of these fabrics is about.
RatingTruth ofTheseFabrics(RatingTruth truth);

}  // namespace stats
