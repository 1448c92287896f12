// A study that is open for writing: its locked store, its protocol and its stimuli. Also the blinded overview that the study
// page shows.
#pragma once

#include <QString>
#include <QStringList>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "database/evidence/operator_latency.h"
#include "database/server/station_store.h"
#include "protocols/protocol.h"
#include "rendering/display/stimulus_bank.h"

namespace study::app {

/// Progress of all participants. Contains no condition, no file code and no score.
struct StudyOverview {
    /// A place of the study and its participant. A participant who withdrew keeps an entry of their own; the freed place
    /// follows as another entry.
    struct ParticipantPlace {
        int number = 0;
        database::SlotState state = database::SlotState::Free;
        QString participant;  ///< empty if the place is free
        database::ParticipantKind kind = database::ParticipantKind::Human;
        int answers = 0;  ///< stored answers that are not voided
        /// The participant withdrew at a station, and the server gives the place to nobody before the study's owner releases it.
        bool isHeld = false;
        bool operator==(const ParticipantPlace&) const = default;
    };
    QString name;
    QString folder;
    std::vector<ParticipantPlace> places;
    int answersInAll = 0;  ///< answers of one complete session
    QString nextParticipant;
    bool isAtStation = false;  ///< the study lies on a server
    bool operator==(const StudyOverview&) const = default;

    int placesIn(database::SlotState state) const;
    bool hasHeldPlace() const;
};

/// The folder of a study that the operator named. An address of a server becomes the folder of this station, which is made at the
/// first time, below the user's data; a folder of the same study takes the address over. Throws the errors of
/// database::stationFolder.
std::filesystem::path folderOfStudy(const std::filesystem::path& place);

class OpenStudy {
public:
    /// Throws the errors of database::StudyStore, and badInput if the stored protocol cannot be read.
    explicit OpenStudy(const std::filesystem::path& folder);

    database::SessionStore& store() { return *m_store; }
    /// Reads the stimuli at the first call. Throws workFailed where one is missing or altered.
    rendering::PresentedImages& images();
    /// How this station stands with its server; none for a study in a folder. Speaks to the server: call it every few seconds.
    std::optional<database::StationStore::Link> serverLink();
    /// Enrols a participant whom no other station may have enrolled since overview(). Throws badInput.
    void enrolNew(const protocols::ParticipantId& participant, database::ParticipantKind kind);
    /// Ends the session's hold on its participant, so that any station can continue the session. Never throws.
    void leaveParticipant();
    const protocols::Protocol& protocol() const { return m_protocol; }
    QString name() const;
    bool isAtStation() const { return m_station != nullptr; }
    /// Which package a font for the participants' language needs; empty if there is one.
    QString fontFault() const;
    StudyOverview overview() const;
    /// Adds a run of the latency task to the log. Throws the errors of database::recordOperatorLatency.
    void storeLatency(const database::OperatorLatency& run);
    /// Message if protocol.json was changed, so that no session can run, with the next step; otherwise empty.
    QString protocolFault() const;
    /// Codes on the fabric pieces of the next participant; names of the fabrics where pieces have no codes. Empty at a station:
    /// its server tells the codes only of a participant at work there.
    QStringList codesOnPieces() const;
    /// The time of the last entry of the log, or of the making of the study, ISO 8601.
    std::string lastWallTime() const;

private:
    std::unique_ptr<database::SessionStore> m_store;
    database::StationStore* m_station = nullptr;  ///< the store, for a study on a server
    database::StudyFacts m_facts;
    protocols::Protocol m_protocol;
    std::unique_ptr<rendering::PresentedImages> m_images;
};

}  // namespace study::app
