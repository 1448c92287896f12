// The registered plans of a study as the report sees them, and their files as `vis2hap verify` checks them.
#pragma once

#include <string>
#include <vector>

#include "database/preregistrations.h"
#include "reports/data/study_data.h"

namespace study::records {

/// The plan that the analysis follows: the last one registered before the first answer and before the unblinding; if there is
/// none, the first one. Null where none is registered.
const database::PreregistrationRecord* followedOf(const std::vector<database::PreregistrationRecord>& records);

/// Sets what was planned, by the registered plan or else by the study's first protocol: bounds, planned contrasts, design,
/// registrations. Names no condition while `data` is blinded. Throws workFailed where a registered plan cannot be read.
void describePlan(const database::StudyStore& store, reports::StudyData& data);

/// One line for each registered file in the study folder that is missing or altered.
std::vector<std::string> faultsOfRegisteredFiles(const database::StudyStore& store);

}  // namespace study::records
