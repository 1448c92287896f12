// Descriptions of one sample, and speed together with accuracy.
#pragma once

#include "study/analyse/named_analysis.h"

namespace study::analyse {

std::vector<NamedAnalysis> analysesOfSamples();

}  // namespace study::analyse
