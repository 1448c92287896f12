// The steps of the page "Data set from photographs": the same readers, warnings and renderings as `vis2hap import photos` and
// `vis2hap render`.
#pragma once

#include "study/app/state/photograph_steps.h"

namespace study::photographs {

/// Every step refuses files of a study that is not unblinded.
app::PhotographSteps photographSteps();

}  // namespace study::photographs
