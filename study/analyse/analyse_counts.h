// Analyses of counts of correct and wrong choices, and corrections for several tests.
#pragma once

#include "study/analyse/named_analysis.h"

namespace study::analyse {

std::vector<NamedAnalysis> analysesOfCounts();

}  // namespace study::analyse
