// Generated against measured signals of a study's fabrics, as the report shows them. A number that does not exist carries
// its reason.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace reports {

/// Two one-sided tests of the mean difference against bounds in the unit of the signal.
struct SignalEquivalence {
    stats::Interval bounds;
    std::string boundsAre;  ///< how the bounds were chosen, in words
    stats::Value pLower;
    stats::Value pUpper;
    stats::Value p;
    stats::Interval ci90;
    std::optional<bool> equivalent;
    std::string whyNoVerdict;  ///< reason where `equivalent` is missing
    std::string verdict;
};

/// Paired t test of generated minus measured means, one pair a fabric.
struct SignalTest {
    std::string signal;  ///< "friction" or "height"
    std::string unit;    ///< what one pair is: "fabric"
    std::size_t n = 0;
    stats::Value meanDifference;
    stats::Value statistic;
    stats::Value df;
    stats::Value p;
    stats::Interval ci95;
    SignalEquivalence equivalence;
};

struct SignalComparison {
    stats::Value frictionMae;
    stats::Value frictionMaeOverMean;
    stats::Value heightSsim;
    stats::Value heightRangeMm;  ///< L of the SSIM
    std::vector<SignalTest> tests;
};

}  // namespace reports
