// The registered plans of a study as the report sees them, and their files as `vis2hap verify` checks them.
#pragma once

#include <string>
#include <vector>

#include "database/preregistrations.h"
#include "protocols/protocol.h"
#include "reports/data/study_data.h"

namespace study::records {

/// Sets what was planned, by the registered plan or else by the last protocol before the first answer: bounds, planned contrasts,
/// design, registrations. A plan that was registered late and changes the bounds or contrasts of that protocol is not followed.
/// Names no condition while `data` is blinded. Throws workFailed where a registered plan cannot be read.
void describePlan(const database::StudyStore& store, reports::StudyData& data);

/// Why an amendment that changes bounds or contrasts will not change the plan, as a phrase; empty where it will, or changes none.
std::string noteOnPlan(const database::StudyStore& store, const protocols::Protocol& amended);

/// One line for each registered file in the study folder that is missing or altered.
std::vector<std::string> faultsOfRegisteredFiles(const database::StudyStore& store);

}  // namespace study::records
