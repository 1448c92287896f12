// Analyses of variance of two factors, from long rows.
#pragma once

#include "study/analyse/named_analysis.h"

namespace study::analyse {

std::vector<NamedAnalysis> analysesOfDesigns();

}  // namespace study::analyse
