// Extreme slopes, photographs, traces and maps for the signals and friction images.
#pragma once

#include <vector>

#include "study/bench/extremes/extreme_case.h"

namespace study::bench {

std::vector<ExtremeCase> extremeSignals();

}  // namespace study::bench
