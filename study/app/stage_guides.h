// What the operator is told at each stage that is not a trial.
#pragma once

#include "study/app/guide_page.h"

namespace study::app {

/// Empty for the two stages of a trial.
std::optional<Guide> guideFor(const session::View& view);

}  // namespace study::app
