// What a blinded study shows: progress, balance and flags; to who gives its passphrase also rounded means under K-labels.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "database/study_store.h"
#include "reports/data/study_data.h"
#include "reports/progress_report.h"

namespace study::records {

reports::ProgressReport blindedReport(const database::StudyStore& store);

/// What a blinded study shows under K-labels to who gives its passphrase.
struct Aggregates {
    /// One row a question and condition: "question", "condition", "n", "share" (choices) and "mean" (ratings). Both are rounded,
    /// over all places of the study (reports/cells/blinded_means.h). Empty before all of them are finished.
    nlohmann::ordered_json rows;
    std::string why;  ///< one sentence: why there are no rows; empty where there are
};
/// `data`: of a blinded study; none where nobody gave its passphrase.
Aggregates aggregatesOf(const std::optional<reports::StudyData>& data);

}  // namespace study::records
