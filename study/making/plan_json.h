// The plan of a study as JSON, schema vis2hap.preregistration/1.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/making/study_plan.h"

namespace study::making {

/// What is planned, without its power and without the identity of the study. Two registrations with equal parts are one.
nlohmann::ordered_json plannedPart(const StudyPlan& plan);

/// The whole file preregistration.json. `textSha256`: the hash of preregistration.txt.
std::string planJson(const StudyPlan& plan, const RegistrationStamp& stamp, const std::string& textSha256);

}  // namespace study::making
