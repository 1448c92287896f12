// Means of participants crossed with fabrics, and the claims that rest on them.
#pragma once

#include "study/analyse/named_analysis.h"

namespace study::analyse {

std::vector<NamedAnalysis> analysesOfClaims();

}  // namespace study::analyse
