// Tests of more than two conditions or groups, and measures of agreement.
#pragma once

#include "study/analyse/named_analysis.h"

namespace study::analyse {

std::vector<NamedAnalysis> analysesOfTables();

}  // namespace study::analyse
