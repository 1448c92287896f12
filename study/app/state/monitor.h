// How a study stands while it runs, for its principal investigator: who is where, which cells are missing, and flags.
// Blinded: places, stages and counts, nothing of what was shown or answered, and no running scores. Reads only.
#pragma once

#include <QString>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"

namespace study::app {

/// A finished verdict on a participant's data, or on the study's.
struct MonitorFlag {
    std::string participant;  ///< empty: of the whole study
    std::string flag;         ///< "too_fast"
    std::string why;          ///< a sentence, with what the flag does not show
    bool operator==(const MonitorFlag&) const = default;
};

/// Assembled where reports may be read. Called off the GUI thread; throws protocols::Error.
using ReadFlags = std::function<std::vector<MonitorFlag>(const database::StudyStore&)>;

struct MonitorOverview {
    struct ParticipantRow {
        int place = 0;
        database::SlotState state = database::SlotState::Free;
        database::ParticipantKind kind = database::ParticipantKind::Human;
        QString participant = {};  ///< empty while the place is free
        QString stage = {};        ///< "question Q2", "break", "paused (tray)"
        int presentation = 0, presentations = 0;
        int answers = 0, answersInAll = 0;  ///< valid ones; of a whole session, voided presentations given again
        int missing = 0;                    ///< cells passed without a valid answer: voided, and not yet presented again
        int voided = 0;                     ///< presentations
        std::optional<double> minutesSinceEvent = {};
        bool operator==(const ParticipantRow&) const = default;
    };
    QString study;
    bool isBlinded = true;
    std::vector<ParticipantRow> rows;  ///< by place; one who withdrew before the one who took the place over
    int answers = 0;                   ///< valid, of those who did not withdraw
    int answersInAll = 0;              ///< of the whole study
    bool operator==(const MonitorOverview&) const = default;
};

/// `now`: wall time, ISO 8601. Throws as StudyStore does.
MonitorOverview monitorOverview(const database::StudyStore& store, const std::string& now);

}  // namespace study::app
