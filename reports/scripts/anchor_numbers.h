// Answers to anchors for the scripts of a report, which compute floor, reliability and ceiling again.
#pragma once

#include <string>

#include "reports/data/study_data.h"

namespace reports {

/// One row a rating of a mismatched presentation, or a pair of answers to a presentation that came twice:
/// participant,question,fabric,condition,kind,first,second. Empty without anchors.
std::string anchorAnswersCsv(const StudyData& data);

/// Rows of the codebook for it.
std::string anchorCodebookRows();

}  // namespace reports
