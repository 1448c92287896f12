// The same means with and without the participants whose answers carry flags. Both are shown side by side, because data are
// never removed without a word.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/analysis/quality_flags.h"
#include "reports/cells/answer_cells.h"

namespace reports {

struct ExcludedParticipant {
    std::string participant;
    std::vector<FlagKind> flags;
};

/// Share correct or mean rating, over the participants' means.
struct ScreenedMean {
    stats::Value before;
    stats::Value after;
};

struct ScreenedQuestion {
    std::string question;
    std::vector<ScreenedMean> conditions;  ///< in the order of the study's conditions
};

struct Screening {
    std::vector<ExcludedParticipant> excluded;  ///< in the order of their names
    std::size_t participantsBefore = 0;         ///< with an answer, as below
    std::size_t participantsAfter = 0;
    std::vector<ScreenedQuestion> questions;  ///< questions with numbers
    std::string why;                          ///< reason where there are no means: nobody is flagged, or everybody
};

/// The flags that set a participant apart. Missing answers and voided presentations exclude nobody.
std::span<const FlagKind> reasonsToExclude();

Screening screenParticipants(const StudyData& data, const AnswerCells& cells, const std::vector<QualityFlag>& flags);

/// The study without the excluded participants and their answers.
StudyData withoutFlagged(StudyData data, const Screening& screening);

}  // namespace reports
