// Tests of means and of paired differences.
#pragma once

#include "study/analyse/named_analysis.h"

namespace study::analyse {

std::vector<NamedAnalysis> analysesOfMeans();

}  // namespace study::analyse
