// Extreme photographs for the generators, and extreme designs and stored studies.
#pragma once

#include <vector>

#include "study/bench/extremes/extreme_case.h"

namespace study::bench {

/// The cases of the store need a QCoreApplication, those of the generators vis2hap-nn.
std::vector<ExtremeCase> extremeStudies();

}  // namespace study::bench
