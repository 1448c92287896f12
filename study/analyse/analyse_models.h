// Mixed models of ratings and of choices, from long rows.
#pragma once

#include "study/analyse/named_analysis.h"

namespace study::analyse {

std::vector<NamedAnalysis> analysesOfModels();

}  // namespace study::analyse
