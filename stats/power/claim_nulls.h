// Simulated studies in which no claim is true, with interactions of participants and of fabrics with condition: how often the
// claims of the report are made falsely.
#pragma once

#include <vector>

#include "stats/power/calibration_families.h"
#include "stats/power/claim_studies.h"

namespace stats {

/// One family for each null. The tests: a contrast and any contrast of all pairs, for both generalisations; for ratings TOST at
/// a bound; for choices one condition and any condition above chance. Then two tests that make no claim: the t test of the
/// participants' means where fabrics are a sample, and Cochran's Q. Participants and fabrics need at least 2 levels.
std::vector<CalibrationFamily> claimFamilies(const CalibrationOptions& options);

/// The names of tests in these families.
inline constexpr const char* participantMeansOfSampledFabrics = "t test of participants' means, where fabrics are a sample";
inline constexpr const char* cochranOfSampledFabrics = "Cochran's Q, where participants and fabrics are samples";
inline constexpr const char* contrastOfFabricsLikeThese = "contrast, fabrics like these";
inline constexpr const char* anyContrastOfFabricsLikeThese = "any contrast of all pairs, fabrics like these";

}  // namespace stats
