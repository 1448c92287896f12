// A study that is open for writing: its store with the lock, its protocol and its stimuli; and the
// blinded overview that the study page shows.
#pragma once

#include <QString>
#include <filesystem>
#include <vector>

#include "database/study_store.h"
#include "protocols/protocol.h"
#include "rendering/display/stimulus_bank.h"

namespace study::app {

/// Who is where; carries no condition, no file code and no score.
struct StudyOverview {
    /// A place; one whose participant withdrew stands for itself, and the place that it freed follows.
    struct ParticipantPlace {
        int number = 0;
        database::SlotState state = database::SlotState::Free;
        QString participant;  ///< empty while free
        database::ParticipantKind kind = database::ParticipantKind::Human;
        int answers = 0;  ///< stored and not voided
        bool operator==(const ParticipantPlace&) const = default;
    };
    QString name;
    QString folder;
    std::vector<ParticipantPlace> places;
    int answersInAll = 0;  ///< of one whole session
    QString nextParticipant;
    bool operator==(const StudyOverview&) const = default;

    int placesIn(database::SlotState state) const;
};

class OpenStudy {
public:
    /// Throws as database::StudyStore does, and badInput where the kept protocol cannot be read.
    explicit OpenStudy(const std::filesystem::path& folder);

    database::StudyStore& store() { return m_store; }
    rendering::StimulusBank& bank() { return m_bank; }
    const protocols::Protocol& protocol() const { return m_protocol; }
    QString name() const;
    StudyOverview overview() const;
    /// Why no session can be held: protocol.json was changed. Says what to do; empty where all is well.
    QString protocolFault() const;

private:
    database::StudyStore m_store;
    database::StudyFacts m_facts;
    protocols::Protocol m_protocol;
    rendering::StimulusBank m_bank;
};

}  // namespace study::app
