// The extreme inputs given to R, scipy, scikit-image and OpenCV.
#pragma once

#include <vector>

#include "study/bench/extremes/extreme_case.h"

namespace study::bench {

/// Adds the answers of every peer that is installed and has the function. Numbers travel as hexadecimal doubles, so every
/// program gets the same bits.
void addPeerAnswers(std::vector<ExtremeResult>& results);

}  // namespace study::bench
