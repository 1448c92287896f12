// The session that runs: its controller, the operator's page of it, and what it shows to the participant and takes from them.
#pragma once

#include <QObject>
#include <memory>

#include "study/app/state/app_options.h"
#include "study/app/state/open_study.h"
#include "study/app/state/session_controller.h"

namespace study::participant {
struct ParticipantAct;
}

namespace study::app {

class DisplayChoice;
class ParticipantRoom;
class WindowPages;

class SessionRoom : public QObject {
    Q_OBJECT
public:
    /// All of these outlive the room. `options` with a clock; `openStudy`: the window's own, empty while none is open.
    SessionRoom(const AppOptions& options, const std::unique_ptr<OpenStudy>& openStudy, WindowPages& pages,
                ParticipantRoom& participantRoom, const DisplayChoice& displayChoice);

    /// Null while no session runs.
    SessionController* controller() const { return m_controller.get(); }
    /// Enrols the participant, or resumes the session, and shows it. In another study than the open one it is a rehearsal.
    /// Throws protocols::Error.
    void begin(OpenStudy& study, const protocols::ParticipantId& participant, std::unique_ptr<rendering::HapticDisplay> display);
    /// Ends the session as it is, and the connection of its display. Without one it does nothing.
    void end() { m_controller.reset(); }
    /// Pauses a running session. False if the pause cannot be stored; the next attempt then returns true.
    bool pauseForLeaving();
    /// Brings the page up to this moment after another page was in front.
    void showNow();
    /// Shows the participant what belongs to this moment.
    void tellParticipant();

Q_SIGNALS:
    /// The page of the session is in front.
    void begun(const study::app::SessionFacts& facts);
    void viewChanged();

private:
    void connectPage();
    void connectController();
    void present();
    void refresh();
    void takeAct(const participant::ParticipantAct& act);
    /// Shows a new fault of the headphones on the page; whoever runs the session cannot hear them.
    void showSoundFault();

    const AppOptions& m_options;
    const std::unique_ptr<OpenStudy>& m_openStudy;
    WindowPages& m_pages;
    ParticipantRoom& m_participantRoom;
    const DisplayChoice& m_displayChoice;
    std::unique_ptr<SessionController> m_controller;
    QString m_soundFault;  ///< of the headphones, as it was seen last
    bool m_leavingWasRefused = false;
};

}  // namespace study::app
