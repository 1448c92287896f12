// Extreme samples, tables and counts for statistical tests.
#pragma once

#include <vector>

#include "study/bench/extremes/extreme_case.h"

namespace study::bench {

std::vector<ExtremeCase> extremeSamples();

}  // namespace study::bench
