// Simulated studies in which no claim is true, with interactions of participants and of fabrics with condition: how often the
// claims of the report are made falsely.
#pragma once

#include <string>
#include <vector>

#include "stats/power/calibration_families.h"

namespace stats {

/// Interactions of a simulated study: SDs in scale points (ratings) or log odds (choices).
struct ClaimNull {
    bool isChoice = false;
    double participantSd = 0;  ///< participant x condition
    double fabricSd = 0;       ///< fabric x condition
    bool isUnequal = false;    ///< both SDs are 1.2 under the first condition and 0.3 under the others

    std::string text() const;
};

/// Ratings, then choices: SDs of 0, 0.5 and 1 in all combinations, then the unequal conditions.
std::vector<ClaimNull> claimNulls();

/// One family for each null. The tests: a contrast and any contrast of all pairs, for both generalisations; for ratings TOST at
/// a bound; for choices one condition and any condition above chance. Then two tests that make no claim: the t test of the
/// participants' means where fabrics are a sample, and Cochran's Q. Participants and fabrics need at least 2 levels.
std::vector<CalibrationFamily> claimFamilies(const CalibrationOptions& options);

/// SD of the residual of the simulated ratings, scale points.
inline constexpr double claimResidualSd = 0.92;

/// The names of tests in these families.
inline constexpr const char* participantMeansOfSampledFabrics = "t test of participants' means, where fabrics are a sample";
inline constexpr const char* cochranOfSampledFabrics = "Cochran's Q, where participants and fabrics are samples";
inline constexpr const char* contrastOfFabricsLikeThese = "contrast, fabrics like these";
inline constexpr const char* anyContrastOfFabricsLikeThese = "any contrast of all pairs, fabrics like these";

}  // namespace stats
