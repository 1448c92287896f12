// The functions behind the page of the window that shows a data set.
#pragma once

#include "study/app/state/data_look.h"

namespace study::looking {

app::LookAtData lookAtData();

}  // namespace study::looking
