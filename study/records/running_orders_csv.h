// The blinded running orders of a study as a table, for `vis2hap study plan`.
#pragma once

#include <string>

#include "database/study_store.h"

namespace study::records {

/// One row a trial: slot, trial, questions, presentation code, tray (codes of the fabric pieces), and the minute and sitting
/// in which it is expected.
std::string runningOrdersCsv(const database::StudyStore& store);

}  // namespace study::records
