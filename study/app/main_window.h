// The main window: a stack of pages (start, new study, protocol editor, data set, photographs, display, keys, latency, rehearsal,
// participant's screen, study, tools, session), the open study and session, and the appearance. It decides nothing about a
// session; it connects the pages to the controller.
#pragma once

#include <QWidget>
#include <memory>

#include "study/app/pages/setup/rehearsal_page.h"
#include "study/app/pieces/appearance_keys.h"
#include "study/app/state/app_options.h"
#include "study/app/state/display_opening.h"
#include "study/app/state/open_study.h"
#include "study/app/state/session_controller.h"

namespace study::participant {
struct ParticipantAct;
}

namespace study::app {

class MonitorWindow;
class ParticipantRoom;
class ParticipantSide;
class ParticipantSound;
class ServerBar;
class StartPage;
class StrayKeys;
class WindowPages;

class MainWindow : public QWidget {
    Q_OBJECT
public:
    /// Whether a session may be one that another station has begun.
    enum class Enrolment { Any, NewOnly };

    explicit MainWindow(const AppOptions& options, QWidget* parent = nullptr);
    ~MainWindow() override;

    /// Opens the study for writing and shows its page. `place`: its folder, or its address on a server. Throws protocols::Error
    /// and then keeps the current study open.
    void openStudy(const std::filesystem::path& place);
    /// Enrols the participant, or resumes the session, and shows it. Waits for the display. Throws protocols::Error.
    void startSession(const protocols::ParticipantId& participant);
    /// Starts the session of a person only with a display, or where the operator chose to rehearse without one; otherwise shows
    /// the display page with the reason. A driver is waited for on a page of its own. Faults are shown on the page of the study.
    void requestSession(const protocols::ParticipantId& participant, Enrolment enrolment = Enrolment::Any);

    OpenStudy* study() const { return m_study.get(); }
    SessionController* session() const { return m_session.get(); }
    /// The visible page.
    QWidget* currentPage() const;

    /// The language that the operator chose on the start page; the window has closed for it. Empty: none.
    const QString& chosenLanguage() const { return m_chosenLanguage; }

    StartPage& startPage() const;
    ParticipantSide& participantSide() const;
    ParticipantSound& participantSound() const;
    void setAppearance(const Appearance& appearance) { m_appearanceKeys->set(appearance); }

protected:
    void closeEvent(QCloseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    void connectPages();
    void connectDisplayPage();
    void connectSession();
    void begin(OpenStudy& study, const protocols::ParticipantId& participant, std::unique_ptr<rendering::HapticDisplay> display);
    void beginRequested(const protocols::ParticipantId& participant, Enrolment enrolment,
                        std::unique_ptr<rendering::HapticDisplay> display);
    /// Connects the display of the sessions, on the connecting page where its driver must be waited for. Then calls `use`, or
    /// `failed` with the reason; both show the page that comes next.
    void connectDisplay(DisplayOpening::Opened use, DisplayOpening::Failed failed);
    void stopConnecting();
    void useDisplay(const std::string& specification);
    void showDisplay(const QString& why = {});
    void showKeys();
    void connectKeysPages();
    void leaveDisplay();
    void showStart();
    void showStudy();
    void connectTools();
    void connectParticipantSide();
    void showParticipantSide();
    void leaveParticipantSide();
    /// Shows the participant what belongs to this moment.
    void tellParticipant();
    /// Shows a new fault of the headphones on the page of a session; whoever runs it cannot hear them.
    void showSoundFault();
    void takeAct(const participant::ParticipantAct& act);
    void connectRehearsal();
    void showRehearsal();
    /// `displayName`: empty if no display is connected.
    void presentRehearsal(const QString& displayName);
    void playRehearsal(std::unique_ptr<rendering::HapticDisplay> display);
    void showStudyFault(const QString& text);
    /// How this station stands with the server of the study; nothing for a study in a folder.
    void showServerLink();
    /// Opens the monitor of the study, or shows the one that is open. `place`: see openStudy().
    void openMonitor(const std::filesystem::path& place);
    void refreshSession();
    void leaveSession();
    /// Ends a session whose log at the server is another than its own, and says so on the page of the study.
    void leaveStaleSession();
    /// Pauses a running session. False if the pause cannot be stored; the next attempt then returns true.
    bool pauseForLeaving();
    void closeStudy();

    AppOptions m_options;
    AppearanceKeys* m_appearanceKeys;
    std::unique_ptr<OpenStudy> m_study;
    std::shared_ptr<const std::filesystem::path> m_rehearsalFolder;
    std::unique_ptr<OpenStudy> m_rehearsal;        ///< while a rehearsal is played; closes before its folder vanishes
    std::unique_ptr<SessionController> m_session;  ///< of either study; after both, so that it ends first
    DisplayOpening m_opening;
    DisplayOpening::Failed m_stopped;  ///< what follows when the operator stops connecting
    bool m_isRehearsing = false;       ///< the page of the rehearsal is in use
    bool m_leavingWasRefused = false;
    bool m_rehearses = false;                           ///< the operator chose to run sessions without a display
    std::optional<protocols::ParticipantId> m_waiting;  ///< whose session waits for a display
    Enrolment m_waitingEnrolment = Enrolment::Any;

    ParticipantRoom* m_participantRoom;
    WindowPages* m_pages;
    StrayKeys* m_strayKeys;
    ServerBar* m_serverBar;
    QString m_chosenLanguage;
    QString m_soundFault;                        ///< of the headphones, as it was seen last
    QWidget* m_beforeParticipantPage = nullptr;  ///< the page to go back to
    std::filesystem::path m_monitored;
    std::unique_ptr<MonitorWindow> m_monitor;  ///< empty until it is asked for
};

}  // namespace study::app
