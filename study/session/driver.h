// The one way into a session for window, script and simulation: commits an accepted event with its
// answers in one transaction and only then lets the effects out. Opening it replays the log, so a
// session goes on where the last acknowledged event left it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "rendering/display/display.h"
#include "rendering/display/stimulus_bank.h"
#include "study/session/clock.h"
#include "study/session/session.h"
#include "study/session/view.h"

namespace study::session {

/// Under which fact the debriefing is kept.
inline constexpr const char* debriefingFact = "debriefing";

/// What an enrolled participant's session follows. Throws badInput for an unknown participant.
Plan readPlan(const database::StudyStore& store, const protocols::ParticipantId& participant);

/// Throws badInput where protocol.json is not the latest text that the study keeps.
void requireKeptProtocol(const database::StudyStore& store);

class Driver {
public:
    /// Enrols the participant, or finds where they were. `store` must be open for writing.
    Driver(database::StudyStore& store, const protocols::ParticipantId& participant, database::ParticipantKind kind,
           rendering::StimulusBank& bank, rendering::HapticDisplay& display, Clock& clock);

    /// Empty when accepted and on the disk; else why not (nothing has changed then). A display or disk
    /// that fails throws protocols::Error; after a display fault the session is paused, nothing lost.
    std::optional<Refusal> send(const EventBody& event);

    const State& state() const { return m_state; }
    const Plan& plan() const { return m_plan; }
    View view() const;

private:
    void replayLog();
    void commit(const EventBody& body, std::int64_t atNs, SessionStep step);
    void letOut(const std::vector<Effect>& effects);
    void perform(const Effect& effect);
    void prefetchIfPossible(const protocols::FileCode& code);
    void pauseAfterFault();

    database::StudyStore& m_store;
    protocols::ParticipantId m_participant;
    rendering::StimulusBank& m_bank;
    rendering::HapticDisplay& m_display;
    Clock& m_clock;
    Plan m_plan;
    State m_state;
};

}  // namespace study::session
