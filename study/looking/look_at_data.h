// What the app's page for looking at a data set is fed from.
#pragma once

#include "study/app/state/data_look.h"

namespace study::looking {

app::LookAtData lookAtData();

}  // namespace study::looking
