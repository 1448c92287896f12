// Functions that supply the app's page for a data set.
#pragma once

#include "study/app/state/data_look.h"

namespace study::looking {

/// The functions that read overview, sheet and faults of a data set.
app::LookAtData lookAtData();

}  // namespace study::looking
