// The only way into a session, for the window, scripts and simulations. The driver stores an accepted event with its answers in
// one transaction and performs the effects after that. It replays the log when it is opened, so the session continues after the
// last stored event.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "database/session_store.h"
#include "rendering/display/display.h"
#include "rendering/display/stimulus_bank.h"
#include "study/session/clock.h"
#include "study/session/finger_recording.h"
#include "study/session/operated_by.h"
#include "study/session/session.h"
#include "study/session/session_entry.h"
#include "study/session/view.h"

namespace study::session {

/// The plan of an enrolled participant's session. Throws badInput for an unknown participant.
Plan readPlan(const database::SessionStore& store, const protocols::ParticipantId& participant);

/// Throws badInput if protocol.json differs from the latest version in the database.
void requireKeptProtocol(const database::SessionStore& store);

class Driver {
public:
    /// Enrols the participant, or continues their session. `store` must be open for writing. `operatedBy` is recorded with the
    /// sitting, and its operator with every correction and void.
    Driver(database::SessionStore& store, const protocols::ParticipantId& participant, database::ParticipantKind kind,
           rendering::PresentedImages& images, rendering::HapticDisplay& display, Clock& clock, OperatedBy operatedBy = {});

    /// Empty if the event was accepted and is on the disk; else the reason, and nothing has changed. Throws protocols::Error if
    /// the display, the disk or the server fails. After a fault of display or server the session is paused, and no answer is
    /// lost.
    std::optional<Refusal> send(const EventBody& event);

    /// Takes what the display measured of the finger. The samples are stored with the next answer to the presentation; those of a
    /// presentation that is paused or voided before its answer are not stored. Never throws.
    void addFinger(const rendering::FingerReport& report);

    const State& state() const { return m_state; }
    const Plan& plan() const { return m_plan; }
    /// Throws protocols::Error where the head of the log, which it holds while nothing runs, cannot be read.
    View view() const;
    /// The same without the head of the log. Reads nothing, and never throws.
    View viewWithoutHead() const;

private:
    void replayLog();
    void commit(const EventBody& body, std::string payload, std::int64_t atNs, SessionStep step);
    void letOut(const std::vector<Effect>& effects);
    void takeDueTrial();
    void perform(const Effect& effect);
    void prefetchIfPossible(const protocols::SealedCode& code);
    void pauseAfterFault();

    database::SessionStore& m_store;
    protocols::ParticipantId m_participant;
    rendering::PresentedImages& m_images;
    rendering::HapticDisplay& m_display;
    Clock& m_clock;
    OperatedBy m_operatedBy;
    int m_slot = 0;
    Plan m_plan;
    State m_state;
    FingerRecording m_finger;
};

}  // namespace study::session
