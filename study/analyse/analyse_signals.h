// Comparisons of traces and of images.
#pragma once

#include "study/analyse/named_analysis.h"

namespace study::analyse {

std::vector<NamedAnalysis> analysesOfSignals();

}  // namespace study::analyse
