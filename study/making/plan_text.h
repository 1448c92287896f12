// The plan of a study as plain text for reviewers and registries. One sentence or item a line, so that it can be pasted into a
// form.
#pragma once

#include <string>

#include "study/making/study_plan.h"

namespace study::making {

/// The whole file preregistration.txt.
std::string planText(const StudyPlan& plan, const RegistrationStamp& stamp);

}  // namespace study::making
