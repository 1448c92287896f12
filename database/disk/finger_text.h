// Samples of the finger as the compact text of a column.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/finger_sample.h"

namespace database {

/// "0,3120,2005,420;50,12,,-3": for each sample the time since the one before (0.1 ms), then the changes of x and y (0.01 mm)
/// and of the force (mN) against their last known value, empty where the value is missing. The first time is 0. `samples`: in
/// the order of time.
std::string fingerTextOf(std::span<const protocols::FingerSample> samples);

/// The samples of such a text; none where it is damaged. `beganAtNs`: time of the first sample.
std::optional<std::vector<protocols::FingerSample>> fingerSamplesFrom(std::string_view text, std::int64_t beganAtNs);

}  // namespace database
