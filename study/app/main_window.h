// The main window: a stack of pages (start, new study, protocol editor, data set, photographs, display, keys, latency, rehearsal,
// participant's screen, study, tools, session), the open study, the rooms that use the pages, and the appearance. It decides
// nothing about a session; it shows the page that comes next.
#pragma once

#include <QWidget>
#include <memory>

#include "study/app/display_choice.h"
#include "study/app/pieces/appearance_keys.h"
#include "study/app/rehearsal_room.h"
#include "study/app/session_room.h"
#include "study/app/state/app_options.h"
#include "study/app/state/open_study.h"
#include "study/app/state/session_controller.h"

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
    SessionController* session() const { return m_session.controller(); }
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
    void connectRooms();
    void beginRequested(const protocols::ParticipantId& participant, Enrolment enrolment,
                        std::unique_ptr<rendering::HapticDisplay> display);
    void showKeys();
    void connectKeysPages();
    /// Shows the page that was there before the one of the display.
    void leaveDisplay();
    void showStart();
    void showStudy();
    /// Shows the study, and where its progress cannot be read now, the reason beside what was read last.
    void returnToStudy();
    void connectTools();
    void connectParticipantSide();
    void showParticipantSide();
    void leaveParticipantSide();
    void showStudyFault(const QString& text);
    /// How this station stands with the server of the study; nothing for a study in a folder.
    void showServerLink();
    /// Opens the monitor of the study, or shows the one that is open. `place`: see openStudy().
    void openMonitor(const std::filesystem::path& place);
    void leaveSession();
    /// Ends a session whose log at the server is another than its own, and says so on the page of the study.
    void leaveStaleSession();
    void closeStudy();

    AppOptions m_options;
    AppearanceKeys* m_appearanceKeys;
    ParticipantRoom* m_participantRoom;
    WindowPages* m_pages;
    StrayKeys* m_strayKeys;
    ServerBar* m_serverBar;
    std::unique_ptr<OpenStudy> m_study;
    DisplayChoice m_displayChoice;
    SessionRoom m_session;      ///< after the open study, so that the session ends first
    RehearsalRoom m_rehearsal;  ///< ends its session before it closes the study that was played
    QString m_chosenLanguage;
    QWidget* m_beforeParticipantPage = nullptr;  ///< the page to go back to
    std::filesystem::path m_monitored;
    std::unique_ptr<MonitorWindow> m_monitor;  ///< empty until it is asked for
};

}  // namespace study::app
