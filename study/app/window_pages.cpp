#include "study/app/window_pages.h"

#include "study/app/pages/data_page.h"
#include "study/app/pages/editor/editor_page.h"
#include "study/app/pages/new_study_page.h"
#include "study/app/pages/photographs/photographs_page.h"
#include "study/app/pages/session_page.h"
#include "study/app/pages/setup/connecting_page.h"
#include "study/app/pages/setup/display_page.h"
#include "study/app/pages/setup/keys_page.h"
#include "study/app/pages/setup/latency_page.h"
#include "study/app/pages/setup/participant_page.h"
#include "study/app/pages/setup/rehearsal_page.h"
#include "study/app/pages/start_page.h"
#include "study/app/pages/study_page.h"
#include "study/app/pages/tools/tools_page.h"
#include "study/app/participant_room.h"

namespace study::app {

WindowPages::WindowPages(const AppOptions& options, const ParticipantRoom& room, QWidget* parent)
    : QStackedWidget(parent),
      start(new StartPage(this)),
      newStudy(new NewStudyPage(options.makeStudy, this)),
      data(new DataPage(options.lookAtData, this)),
      photographs(new PhotographsPage(options.photographs, this)),
      display(new DisplayPage(options, this)),
      connecting(new ConnectingPage(this)),
      keys(new KeysPage(options.settings, this)),
      latency(new LatencyPage(options.clock, this)),
      participant(new ParticipantPage(room.side(), room.sound(), this)),
      rehearsal(new RehearsalPage(this)),
      study(new StudyPage(this)),
      tools(new ToolsPage(options.useTool, this)),
      session(new SessionPage(this)),
      m_lookAtData(options.lookAtData),
      m_lookAhead(options.lookAhead)
{
    setObjectName("pages");
    for (QWidget* page : std::initializer_list<QWidget*>{start, newStudy, data, photographs, display, connecting, keys, latency,
                                                         participant, rehearsal, study, tools, session})
        addWidget(page);
    connectStart();
    connectEditor();
}

void WindowPages::connectStart()
{
    connect(start, &StartPage::newStudyRequested, this, [this] { bring(*newStudy); });
    connect(start, &StartPage::dataRequested, this, [this] { bring(*data); });
    connect(start, &StartPage::photographsRequested, this, [this] { bring(*photographs); });
    connect(data, &DataPage::backRequested, this, &WindowPages::startRequested);
    connect(photographs, &PhotographsPage::backRequested, this, &WindowPages::startRequested);
    connect(photographs, &PhotographsPage::studyRequested, this, [this](const QString& dataset, const QString& protocol) {
        newStudy->fill(dataset, protocol);
        bring(*newStudy);
    });
    connect(newStudy, &NewStudyPage::backRequested, this, &WindowPages::startRequested);
    connect(newStudy, &NewStudyPage::made, this, &WindowPages::studyMade);
}

EditorPage& WindowPages::showEditor(QWidget& before)
{
    closeEditor();
    m_editor = new EditorPage(m_lookAtData, m_lookAhead, this);
    addWidget(m_editor);
    setCurrentWidget(m_editor);
    // Queued, so that the editor is not destroyed while it handles its own event.
    connect(
        m_editor, &EditorPage::studyRequested, this,
        [this](const QString& protocol) {
            closeEditor();
            newStudy->fillProtocol(protocol);
            bring(*newStudy);
        },
        Qt::QueuedConnection);
    connect(
        m_editor, &EditorPage::backRequested, this,
        [this, &before] {
            closeEditor();
            if (&before == newStudy)
                bring(*newStudy);
            else
                Q_EMIT startRequested();
        },
        Qt::QueuedConnection);
    return *m_editor;
}

void WindowPages::closeEditor()
{
    delete m_editor;
    m_editor = nullptr;
}

bool WindowPages::mayClose() { return !m_editor || currentWidget() != m_editor || m_editor->mayClose(); }

void WindowPages::connectEditor()
{
    connect(start, &StartPage::makeProtocolRequested, this, [this] { showEditor(*start).offerExamples(); });
    connect(start, &StartPage::changeProtocolRequested, this, [this] { showEditor(*start).offerFile(); });
    connect(newStudy, &NewStudyPage::protocolEditRequested, this, [this](const QString& file) {
        EditorPage& editor = showEditor(*newStudy);
        if (file.isEmpty())
            editor.offerExamples();
        else
            editor.open(file.toStdString());
    });
}

}  // namespace study::app
