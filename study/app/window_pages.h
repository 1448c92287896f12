// The pages of the main window, one above the other, and the ways between those that need no study.
#pragma once

#include <QStackedWidget>

#include "study/app/state/app_options.h"

namespace study::app {

class ConnectingPage;
class DataPage;
class DisplayPage;
class EditorPage;
class KeysPage;
class LatencyPage;
class NewStudyPage;
class ParticipantPage;
class PhotographsPage;
class RehearsalPage;
class SessionPage;
class StartPage;
class StudyPage;
class ToolsPage;
class ParticipantRoom;

class WindowPages : public QStackedWidget {
    Q_OBJECT
public:
    /// `options` with a clock; `room`: what the participant's page shows.
    WindowPages(const AppOptions& options, const ParticipantRoom& room, QWidget* parent);

    /// False if a page has changes that are not saved; it then asks what to do with them.
    bool mayClose();

    /// Shows the page, with the focus in its first control.
    template <class Page>
    void bring(Page& page)
    {
        setCurrentWidget(&page);
        page.focusFirst();
    }

    StartPage* const start;
    NewStudyPage* const newStudy;
    DataPage* const data;
    PhotographsPage* const photographs;
    DisplayPage* const display;
    ConnectingPage* const connecting;
    KeysPage* const keys;
    LatencyPage* const latency;
    ParticipantPage* const participant;
    RehearsalPage* const rehearsal;
    StudyPage* const study;
    ToolsPage* const tools;
    SessionPage* const session;

Q_SIGNALS:
    /// The operator leaves a page that needs no study.
    void startRequested();
    void studyMade(const QString& folder, const QStringList& remarks);

private:
    void connectStart();
    void connectEditor();
    /// Shows a new editor; leaving it leads back to `before`. It names conditions, so it is there only while it is used.
    EditorPage& showEditor(QWidget& before);
    void closeEditor();

    LookAtData m_lookAtData;
    LookAhead m_lookAhead;
    EditorPage* m_editor = nullptr;
};

}  // namespace study::app
