// The same means with and without the participants whose answers carry flags: shown beside each other,
// because data are never removed in silence.
#pragma once

#include "reports/analysis/answer_cells.h"
#include "reports/text/number_text.h"

namespace reports {

/// {"excluded": [{participant, flags}], "questions": {Q: {condition: {"before", "after"}}}, "participants":
/// {"before", "after"}}: share correct or mean rating over the participants' means. Missing answers and voided
/// presentations are no reason to exclude. "questions" is null, with its reason, while nobody is flagged or nobody
/// would be left.
Json screeningPart(const StudyData& data, const Cells& cells);

}  // namespace reports
