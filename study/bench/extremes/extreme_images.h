// Extreme pairs of images for structural similarity.
#pragma once

#include <vector>

#include "study/bench/extremes/extreme_case.h"

namespace study::bench {

std::vector<ExtremeCase> extremeImages();

}  // namespace study::bench
