// False claims in 10,000 simulated studies of the paper's size under each null of claim_nulls.h, counted by claimCalibration()
// and stored here.
#pragma once

#include <span>
#include <string_view>

#include "stats/power/claim_nulls.h"
#include "stats/power/measured_size.h"

namespace stats {

/// In the order of claimCalibration().
std::span<const MeasuredSize> measuredClaims();

/// Share of studies in which the test rejects falsely, between the measured SDs by bilinear interpolation; SDs above 1 count
/// as 1. `test`: a name of claim_nulls.h. `null.isUnequal` is ignored.
double falseClaimRate(std::string_view test, const ClaimNull& null);

}  // namespace stats
