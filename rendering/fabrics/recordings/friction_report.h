// Report of the preparation of a friction record: in words, and as the JSON file beside it.
#pragma once

#include <string>

#include "rendering/fabrics/recordings/friction_preparation.h"

namespace rendering::fabrics {

/// Text for people, such as ", slide 0.5 to 8.5 s of 10 s (approach 0.2 s, breakaway 0.3 s, stop 1.5 s cut)".
std::string describeCuts(const PreparedRecord& prepared);

/// Text of the JSON file beside the record, such as F01/friction/000.json. It has "speed_mm_per_s" where the recording states a
/// speed.
std::string preparationJson(const RawRecord& record, const FrictionOptions& options, const PreparedRecord& prepared);

}  // namespace rendering::fabrics
