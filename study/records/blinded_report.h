// What a blinded study shows to who lacks its passphrase: progress, balance and flags.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "database/study_store.h"
#include "reports/data/study_data.h"
#include "reports/progress_report.h"

namespace study::records {

reports::ProgressReport blindedReport(const database::StudyStore& store);

/// Answers under K-labels, one row a question and condition: "question", "condition", "n", "correct" (choices) and "mean"
/// (ratings). `data`: of a blinded study.
nlohmann::ordered_json aggregatesOf(const reports::StudyData& data);

}  // namespace study::records
