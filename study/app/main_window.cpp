#include "study/app/main_window.h"

#include <QCloseEvent>
#include <QKeyEvent>
#include <QScreen>
#include <QShortcut>
#include <QTimer>
#include <QVBoxLayout>
#include <utility>

#include "protocols/files/errors.h"
#include "study/app/language/below.h"
#include "study/app/pages/monitor_window.h"
#include "study/app/pages/session_page.h"
#include "study/app/pages/setup/keys_page.h"
#include "study/app/pages/setup/latency_page.h"
#include "study/app/pages/setup/participant_page.h"
#include "study/app/pages/start_page.h"
#include "study/app/pages/study_page.h"
#include "study/app/pages/tools/tools_page.h"
#include "study/app/participant_room.h"
#include "study/app/server_bar.h"
#include "study/app/showing_faults.h"
#include "study/app/state/recent_studies.h"
#include "study/app/stray_keys.h"
#include "study/app/window_pages.h"

namespace study::app {

namespace {

AppOptions withClock(AppOptions options)
{
    if (!options.clock) options.clock = std::make_shared<session::SystemClock>();
    return options;
}

}  // namespace

MainWindow::MainWindow(const AppOptions& options, QWidget* parent)
    : QWidget(parent),
      m_options(withClock(options)),
      m_appearanceKeys(new AppearanceKeys(options.settings, *this, AppearanceKeys::Growth::WithWindow)),
      m_participantRoom(new ParticipantRoom(this)),
      m_pages(new WindowPages(m_options, *m_participantRoom, this)),
      m_strayKeys(new StrayKeys(*this, *m_pages, m_options.clock)),
      m_serverBar(new ServerBar(this)),
      m_displayChoice(m_options, *m_pages),
      m_session(m_options, m_study, *m_pages, *m_participantRoom, m_displayChoice),
      m_rehearsal(m_options.makeRehearsal, m_study, *m_pages, m_displayChoice, m_session)
{
    setObjectName("mainWindow");
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(m_pages, 1);
    column->addWidget(m_serverBar);
    auto* everyFewSeconds = new QTimer(this);
    connect(everyFewSeconds, &QTimer::timeout, this, &MainWindow::showServerLink);
    everyFewSeconds->start(2000);
    const QSize frame(16, 40);  // the borders and the title that the desktop adds
    const QRect room = screen()->availableGeometry();
    resize(QSize(1100, 750).boundedTo(room.size() - frame));
    move(room.topLeft() + QPoint((room.width() - width()) / 2, (room.height() - height()) / 2));
    connectPages();
    connectRooms();
    connectKeysPages();
    m_pages->study->offerTools(static_cast<bool>(options.useTool));
    connectTools();
    connectParticipantSide();
    connect(new QShortcut(QKeySequence(Qt::CTRL | Qt::Key_Q), this), &QShortcut::activated, this, [this] { close(); });
    showStart();
    if (!m_options.languageFault.isEmpty()) m_pages->start->showFault(m_options.languageFault);
    if (const QString& fault = m_displayChoice.faultOfLastTime(); !fault.isEmpty()) m_pages->start->showFault(fault);
}

MainWindow::~MainWindow() = default;

void MainWindow::connectPages()
{
    connect(m_pages->start, &StartPage::openRequested, this,
            [this](const QString& folder) { showingFaults(*m_pages->start, [&] { openStudy(folder.toStdString()); }); });
    connect(m_pages->start, &StartPage::monitorRequested, this,
            [this](const QString& place) { showingFaults(*m_pages->start, [&] { openMonitor(place.toStdString()); }); });
    m_pages->start->offerLanguages(m_options.language);
    connect(m_pages->start, &StartPage::languageChosen, this, [this](const QString& tag) {
        if (tag == m_options.language.tag) return;
        m_chosenLanguage = tag;
        close();  // the program opens another one with texts in this language
    });
    connect(m_pages, &WindowPages::startRequested, this, &MainWindow::showStart);
    connect(m_pages, &WindowPages::studyMade, this, [this](const QString& folder, const QStringList& remarks) {
        showStart();
        showingFaults(*m_pages->start, [&] {
            openStudy(folder.toStdString());
            m_pages->study->showRemarks(remarks);
        });
    });
    connect(m_pages->study, &StudyPage::closeRequested, this, &MainWindow::closeStudy);
    connect(m_pages->study, &StudyPage::secondEnterAsked, m_strayKeys, &StrayKeys::holdEnterOfStudy);
    const auto request = [this](const QString& participant, Enrolment enrolment) {
        if (const QString fault = m_study->protocolFault(); !fault.isEmpty()) return m_pages->study->showFault(fault);
        requestSession(protocols::ParticipantId(participant.toStdString()), enrolment);
    };
    connect(m_pages->study, &StudyPage::sessionRequested, this,
            [request](const QString& participant) { request(participant, Enrolment::Any); });
    connect(m_pages->study, &StudyPage::enrolmentRequested, this,
            [request](const QString& participant) { request(participant, Enrolment::NewOnly); });
    connect(m_pages->study, &StudyPage::placesWanted, this,
            [this] { showingFaults(*m_pages->study, [this] { m_pages->study->refresh(m_study->overview()); }); });
    // Queued, so that the page is not rebuilt while it still handles its own event.
    connect(m_pages->session, &SessionPage::leaveRequested, this, &MainWindow::leaveSession, Qt::QueuedConnection);
}

void MainWindow::connectRooms()
{
    connect(&m_displayChoice, &DisplayChoice::left, this, &MainWindow::leaveDisplay);
    connect(&m_rehearsal, &RehearsalRoom::left, this, &MainWindow::returnToStudy);
    connect(&m_session, &SessionRoom::viewChanged, this, &MainWindow::showServerLink);
    connect(&m_session, &SessionRoom::begun, this, [this](const SessionFacts& facts) {
        setWindowTitle(facts.isRehearsal ? tr("Rehearsal – %1 – Vis2Hap").arg(m_study->name())
                                         : tr("%1 – %2 – Vis2Hap").arg(facts.participant, m_study->name()));
    });
}

void MainWindow::connectKeysPages()
{
    connect(m_pages->start, &StartPage::keysRequested, this, &MainWindow::showKeys);
    connect(m_pages->study, &StudyPage::keysRequested, this, &MainWindow::showKeys);
    connect(m_pages->keys, &KeysPage::backRequested, &m_displayChoice, &DisplayChoice::leave);
    connect(m_pages->latency, &LatencyPage::backRequested, this, &MainWindow::showKeys);
    connect(m_pages->keys, &KeysPage::latencyTaskRequested, this, [this] {
        m_pages->latency->present(QString::fromStdString(m_options.operatedBy.operatorName));
        m_pages->bring(*m_pages->latency);
    });
    connect(m_pages->latency, &LatencyPage::measured, this, [this](const database::OperatorLatency& run) {
        showingFaults(*m_pages->latency, [&] {
            m_study->storeLatency(run);
            m_pages->latency->showStored(run);
        });
    });
}

void MainWindow::connectParticipantSide()
{
    auto* shortcut = new QShortcut(QKeySequence(Qt::Key_F4), this);
    shortcut->setAutoRepeat(false);
    connect(shortcut, &QShortcut::activated, this, &MainWindow::showParticipantSide);
    connect(m_pages->start, &StartPage::participantRequested, this, &MainWindow::showParticipantSide);
    connect(m_pages->study, &StudyPage::participantRequested, this, &MainWindow::showParticipantSide);
    connect(m_pages->participant, &ParticipantPage::backRequested, this, &MainWindow::leaveParticipantSide);
    m_session.tellParticipant();
}

void MainWindow::showParticipantSide()
{
    if (m_pages->currentWidget() == m_pages->participant) return leaveParticipantSide();
    if (m_displayChoice.isConnecting()) return;  // another page comes by itself in a moment
    m_beforeParticipantPage = m_pages->currentWidget();
    m_pages->participant->present();
    m_pages->bring(*m_pages->participant);
}

void MainWindow::leaveParticipantSide()
{
    m_pages->setCurrentWidget(m_beforeParticipantPage);
    m_session.showNow();
}

void MainWindow::showKeys()
{
    m_pages->keys->present();
    m_pages->keys->offerLatencyTask(m_study != nullptr);
    m_pages->bring(*m_pages->keys);
}

void MainWindow::leaveDisplay()
{
    if (m_rehearsal.isInUse())
        m_rehearsal.show();
    else if (m_study)
        returnToStudy();
    else
        showStart();
}

void MainWindow::connectTools()
{
    connect(m_pages->study, &StudyPage::toolsRequested, this, [this] {
        m_pages->tools->present(m_study->store().folder().folder);
        m_pages->bring(*m_pages->tools);
    });
    connect(m_pages->tools, &ToolsPage::backRequested, this, &MainWindow::returnToStudy);
    connect(m_pages->tools, &ToolsPage::monitorRequested, this,
            [this] { showingFaults(*m_pages->tools, [&] { openMonitor(m_study->store().folder().folder); }); });
}

void MainWindow::openMonitor(const std::filesystem::path& place)
{
    if (!m_monitor || m_monitored != place) m_monitor = std::make_unique<MonitorWindow>(place, m_options);
    m_monitored = place;
    m_monitor->show();
    m_monitor->raise();
    m_monitor->activateWindow();
}

StartPage& MainWindow::startPage() const { return *m_pages->start; }

QWidget* MainWindow::currentPage() const { return m_pages->currentWidget(); }

ParticipantSide& MainWindow::participantSide() const { return m_participantRoom->side(); }

ParticipantSound& MainWindow::participantSound() const { return m_participantRoom->sound(); }

void MainWindow::showStart()
{
    setWindowTitle(tr("Vis2Hap"));
    m_pages->start->present(recentStudies(m_options.settings.get()),
                            {static_cast<bool>(m_options.makeStudy), static_cast<bool>(m_options.lookAtData),
                             static_cast<bool>(m_options.photographs)});
    m_pages->bring(*m_pages->start);
}

void MainWindow::openStudy(const std::filesystem::path& place)
{
    const std::filesystem::path folder = folderOfStudy(place);
    auto opened = std::make_unique<OpenStudy>(folder);
    m_session.end();
    m_monitor.reset();
    m_study = std::move(opened);
    const auto whole = std::filesystem::absolute(folder).lexically_normal();
    rememberStudy(m_options.settings.get(), QString::fromStdString(whole.string()));
    m_session.tellParticipant();
    showStudy();
}

void MainWindow::showStudy()
{
    setWindowTitle(tr("%1 – Vis2Hap").arg(m_study->name()));
    m_pages->study->present(m_study->overview(), m_options.kind);
    for (const QString& fault : {m_study->fontFault(), m_study->protocolFault()})
        if (!fault.isEmpty()) m_pages->study->showFault(fault);
    m_pages->bring(*m_pages->study);
    showServerLink();
}

void MainWindow::returnToStudy()
{
    try {
        showStudy();
    } catch (const std::exception& fault) {
        showStudyFault(inOwnLanguage(fault.what()));
    }
}

void MainWindow::showServerLink()
{
    const auto link = m_study ? m_study->serverLink() : std::nullopt;
    m_serverBar->present(link);
    // Queued, because the session may be the one that asks.
    if (link && !link->stale.empty() && session() && !m_rehearsal.isPlaying())
        QMetaObject::invokeMethod(this, &MainWindow::leaveStaleSession, Qt::QueuedConnection);
}

void MainWindow::leaveStaleSession()
{
    const auto link = m_study ? m_study->serverLink() : std::nullopt;
    if (!link || link->stale.empty() || !session()) return;
    m_session.end();
    m_study->leaveParticipant();
    m_strayKeys->holdEnterOfStudy();
    m_session.tellParticipant();
    showingFaults(*m_pages->study, [this] { showStudy(); });
    showStudyFault(inOwnLanguage(link->stale));
}

void MainWindow::closeStudy()
{
    m_session.end();
    m_monitor.reset();
    m_study.reset();
    showServerLink();
    showStart();
    m_session.tellParticipant();
}

void MainWindow::startSession(const protocols::ParticipantId& participant)
{
    m_session.end();  // A driver serves one connection at a time.
    m_session.begin(*m_study, participant, m_options.openDisplay(m_displayChoice.specification(), {}));
}

void MainWindow::beginRequested(const protocols::ParticipantId& participant, Enrolment enrolment,
                                std::unique_ptr<rendering::HapticDisplay> display)
{
    try {
        if (enrolment == Enrolment::NewOnly) m_study->enrolNew(participant, m_options.kind);
        m_session.begin(*m_study, participant, std::move(display));
    } catch (const std::exception& fault) {
        m_session.end();
        m_study->leaveParticipant();
        showStudyFault(inOwnLanguage(fault.what()));
    }
}

void MainWindow::requestSession(const protocols::ParticipantId& participant, Enrolment enrolment)
{
    m_session.end();
    const auto use = [this, participant, enrolment](std::unique_ptr<rendering::HapticDisplay> display) {
        if (display->isThere() || m_displayChoice.rehearses() || m_options.kind != database::ParticipantKind::Human)
            return beginRequested(participant, enrolment, std::move(display));
        display.reset();
        m_displayChoice.showFor(
            tr("No display is connected, so %1 would feel nothing. Connect a display, or rehearse without one.")
                .arg(QString::fromStdString(participant.value)),
            [this, participant, enrolment] { requestSession(participant, enrolment); });
    };
    m_displayChoice.connectDisplay(use, [this](const QString& fault) { showStudyFault(fault); });
}

void MainWindow::showStudyFault(const QString& text)
{
    if (m_pages->currentWidget() != m_pages->study) {
        m_pages->bring(*m_pages->study);
    }
    m_pages->study->showFault(text);
}

void MainWindow::leaveSession()
{
    if (!session() || !m_session.pauseForLeaving()) return;
    const bool isFinished = std::holds_alternative<session::Finished>(session()->view().state.stage);
    m_session.end();
    m_strayKeys->holdEnterOfStudy();
    if (m_rehearsal.isPlaying()) {
        m_rehearsal.leaveSession(isFinished);
    } else {
        m_study->leaveParticipant();
        returnToStudy();
    }
    m_session.tellParticipant();
}

void MainWindow::closeEvent(QCloseEvent* event)
{
    if (session() && !m_pages->session->mayClose()) {
        m_pages->setCurrentWidget(m_pages->session);
        event->ignore();
        return;
    }
    if (session() && !m_session.pauseForLeaving()) {
        event->ignore();
        return;
    }
    if (!m_pages->mayClose()) {
        event->ignore();
        return;
    }
    m_monitor.reset();  // an open monitor would keep the program running
    m_pages->participant->closeWindow();
    QWidget::closeEvent(event);
}

void MainWindow::keyPressEvent(QKeyEvent* event)
{
    // Handles the keys of the session page when none of its controls has the focus.
    if (m_pages->currentWidget() == m_pages->session && event->modifiers() == Qt::NoModifier && !m_strayKeys->isRepeat(*event) &&
        m_pages->session->pressKey(event->key()))
        return;
    QWidget::keyPressEvent(event);
}

}  // namespace study::app
