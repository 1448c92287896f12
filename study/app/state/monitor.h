// Progress of a running study, for its principal investigator: the stage of every participant, missing cells, and flags.
// Blinded: it contains places, stages and counts, but no stimuli, answers or scores. It only reads the study. For a study on a
// server it also contains the stations.
#pragma once

#include <QString>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"

namespace study::app {

/// Data-quality flag on a participant or on the whole study.
struct MonitorFlag {
    std::string participant;  ///< empty: the flag concerns the whole study
    std::string flag;         ///< "too_fast"
    std::string why;          ///< a sentence with the reason and the limits of the flag
    bool operator==(const MonitorFlag&) const = default;
};

/// Reads the flags of a study. Called on a worker thread; throws protocols::Error. main supplies it, because this folder
/// does not include the reports.
using ReadFlags = std::function<std::vector<MonitorFlag>(const database::StudyStore&)>;

/// The study as it stands now. Throws the errors of database::readStudy.
database::StudyStore readMonitored(const std::filesystem::path& study);

struct MonitorOverview {
    struct ParticipantRow {
        int place = 0;
        database::SlotState state = database::SlotState::Free;
        database::ParticipantKind kind = database::ParticipantKind::Human;
        QString participant = {};  ///< empty if the place is free
        QString stage = {};        ///< "question Q2", "break", "paused (tray)"
        int presentation = 0, presentations = 0;
        int answers = 0;       ///< valid answers
        int answersInAll = 0;  ///< answers of a complete session; 0 if unknown
        int missing = 0;       ///< answers to voided presentations that have not been repeated yet
        int voided = 0;        ///< number of voided presentations
        std::optional<double> minutesSinceEvent = {};
        bool operator==(const ParticipantRow&) const = default;
    };
    /// A station of a study on a server.
    struct StationRow {
        enum class Contact { Connected, Lost, Unknown };  ///< Unknown: the server does not reply any more
        QString station;
        QString participant;  ///< at work there; empty without a session
        Contact contact = Contact::Connected;
        std::optional<int> secondsSinceSign;  ///< since the last sign of life; empty for an earlier connection of the station
        int waiting = 0;                      ///< entries in its queue, as it reported last
        QString program;                      ///< name and version; empty if unknown
        bool operator==(const StationRow&) const = default;
    };
    QString study;
    std::optional<bool> isBlinded = true;  ///< empty if only states and counts are known
    std::vector<ParticipantRow> rows;      ///< by place; a withdrawn participant comes before the next one in this place
    int answers = 0;                       ///< valid answers, without participants who withdrew
    int answersInAll = 0;                  ///< answers of the complete study; 0 if unknown
    /// By name, then earlier connections with entries that may still wait. Empty for a study in a folder.
    std::optional<std::vector<StationRow>> stations = {};
    bool operator==(const MonitorOverview&) const = default;
};

/// Reads the overview. `now`: wall time, ISO 8601. Throws the errors of StudyStore.
MonitorOverview monitorOverview(const database::StudyStore& store, const std::string& now);

}  // namespace study::app
