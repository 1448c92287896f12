#include "study/app/main_window.h"

#include <QCloseEvent>
#include <QKeyEvent>
#include <QScreen>
#include <QShortcut>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "protocols/files/errors.h"
#include "study/app/pages/data_page.h"
#include "study/app/pages/monitor_window.h"
#include "study/app/pages/new_study_page.h"
#include "study/app/pages/photographs/photographs_page.h"
#include "study/app/pages/session_page.h"
#include "study/app/pages/setup/display_page.h"
#include "study/app/pages/setup/keys_page.h"
#include "study/app/pages/setup/latency_page.h"
#include "study/app/pages/setup/participant_page.h"
#include "study/app/pages/setup/rehearsal_page.h"
#include "study/app/pages/setup/room_checks.h"
#include "study/app/pages/stage_page.h"
#include "study/app/pages/start_page.h"
#include "study/app/pages/study_page.h"
#include "study/app/pages/tools/tools_page.h"
#include "study/app/participant_room.h"
#include "study/app/pieces/pieces.h"
#include "study/app/state/recent_studies.h"

namespace study::app {

namespace {

/// Runs `work` and shows its fault on `page`, where the operator asked for it.
template <class Page, class Work>
void showingFaults(Page& page, Work work)
{
    try {
        work();
    } catch (const std::exception& fault) {
        page.showFault(QString::fromUtf8(fault.what()));
    }
}

}  // namespace

MainWindow::MainWindow(const AppOptions& options, QWidget* parent)
    : QWidget(parent),
      m_options(options),
      m_appearanceKeys(new AppearanceKeys(options.settings, *this, AppearanceKeys::Growth::WithWindow)),
      m_pages(new QStackedWidget(this)),
      m_startPage(new StartPage(this)),
      m_newStudyPage(new NewStudyPage(options.makeStudy, this)),
      m_dataPage(new DataPage(options.lookAtData, this)),
      m_photographsPage(new PhotographsPage(options.photographs, this)),
      m_displayPage(new DisplayPage(options, this)),
      m_keysPage(new KeysPage(options.settings, this)),
      m_participantRoom(new ParticipantRoom(this)),
      m_participantPage(new ParticipantPage(m_participantRoom->side(), m_participantRoom->sound(), this)),
      m_rehearsalPage(new RehearsalPage(this)),
      m_studyPage(new StudyPage(this)),
      m_toolsPage(new ToolsPage(options.useTool, this)),
      m_sessionPage(new SessionPage(this))
{
    setObjectName("mainWindow");
    if (!m_options.clock) m_options.clock = std::make_shared<session::SystemClock>();
    m_latencyPage = new LatencyPage(m_options.clock, this);
    m_pages->setObjectName("pages");
    for (QWidget* page :
         {static_cast<QWidget*>(m_startPage), static_cast<QWidget*>(m_newStudyPage), static_cast<QWidget*>(m_dataPage),
          static_cast<QWidget*>(m_photographsPage), static_cast<QWidget*>(m_displayPage), static_cast<QWidget*>(m_keysPage),
          static_cast<QWidget*>(m_latencyPage), static_cast<QWidget*>(m_participantPage), static_cast<QWidget*>(m_rehearsalPage),
          static_cast<QWidget*>(m_studyPage), static_cast<QWidget*>(m_toolsPage), static_cast<QWidget*>(m_sessionPage)})
        m_pages->addWidget(page);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(m_pages);
    const QSize frame(16, 40);  // the borders and the title that the desktop adds
    const QRect room = screen()->availableGeometry();
    resize(QSize(1100, 750).boundedTo(room.size() - frame));
    move(room.topLeft() + QPoint((room.width() - width()) / 2, (room.height() - height()) / 2));
    m_rehearses = options.isDisplayGiven && options.display == "none";
    const std::string remembered = rememberedDisplay(options.settings.get());
    const bool isAllowed = options.allowsPlainImages || !leavesPlainImages(remembered);
    const bool isWanted = !options.isDisplayGiven && options.kind == database::ParticipantKind::Human && !remembered.empty();
    if (isWanted && isAllowed) useDisplay(remembered);
    connectPages();
    connectDisplayPage();
    connectKeysPages();
    m_studyPage->offerTools(static_cast<bool>(options.useTool));
    connectTools();
    connectParticipantSide();
    connectRehearsal();
    connect(new QShortcut(QKeySequence(Qt::CTRL | Qt::Key_Q), this), &QShortcut::activated, this, [this] { close(); });
    showStart();
    if (isWanted && !isAllowed)
        m_startPage->showFault(
            tr("The display of the last time, %1, is not connected: an operator could open its plain images. Choose "
               "another display here, or start the program with --plain-images.")
                .arg(QString::fromStdString(remembered)));
}

MainWindow::~MainWindow() = default;

void MainWindow::connectPages()
{
    connect(m_startPage, &StartPage::openRequested, this,
            [this](const QString& folder) { showingFaults(*m_startPage, [&] { openStudy(folder.toStdString()); }); });
    connect(m_startPage, &StartPage::newStudyRequested, this, [this] {
        m_pages->setCurrentWidget(m_newStudyPage);
        m_newStudyPage->focusFirst();
    });
    connect(m_startPage, &StartPage::dataRequested, this, [this] {
        m_pages->setCurrentWidget(m_dataPage);
        m_dataPage->focusFirst();
    });
    connect(m_dataPage, &DataPage::backRequested, this, &MainWindow::showStart);
    connect(m_startPage, &StartPage::photographsRequested, this, [this] {
        m_pages->setCurrentWidget(m_photographsPage);
        m_photographsPage->focusFirst();
    });
    connect(m_photographsPage, &PhotographsPage::backRequested, this, &MainWindow::showStart);
    connect(m_photographsPage, &PhotographsPage::studyRequested, this, [this](const QString& dataset, const QString& protocol) {
        m_newStudyPage->fill(dataset, protocol);
        m_pages->setCurrentWidget(m_newStudyPage);
        m_newStudyPage->focusFirst();
    });
    connect(m_newStudyPage, &NewStudyPage::backRequested, this, &MainWindow::showStart);
    connect(m_newStudyPage, &NewStudyPage::made, this, [this](const QString& folder) {
        showStart();
        showingFaults(*m_startPage, [&] { openStudy(folder.toStdString()); });
    });
    connect(m_studyPage, &StudyPage::closeRequested, this, &MainWindow::closeStudy);
    connect(m_studyPage, &StudyPage::sessionRequested, this, [this](const QString& participant) {
        if (const QString fault = m_study->protocolFault(); !fault.isEmpty()) return m_studyPage->showFault(fault);
        showingFaults(*m_studyPage, [&] { requestSession(protocols::ParticipantId(participant.toStdString())); });
    });
    connect(m_sessionPage, &SessionPage::correctionRequested, this,
            [this] { m_sessionPage->openCorrection(m_session->correctables()); });
    connect(m_sessionPage, &SessionPage::eventRequested, this, [this](const session::EventBody& event) {
        if (m_session) m_session->send(event);
    });
    connect(m_sessionPage, &SessionPage::answerMarked, this, [this](AnswerMark mark) {
        if (!m_session) return;
        if (mark == AnswerMark::Emptied)
            m_session->unmarkEntry();
        else
            m_session->markAnswerBegun(mark == AnswerMark::Spoken ? session::BegunBy::Spoken : session::BegunBy::Entry);
    });
    // Queued, so that the page is not rebuilt while it still handles its own event.
    connect(m_sessionPage, &SessionPage::leaveRequested, this, &MainWindow::leaveSession, Qt::QueuedConnection);
}

void MainWindow::connectDisplayPage()
{
    connect(m_startPage, &StartPage::displayRequested, this, [this] { showDisplay(); });
    connect(m_studyPage, &StudyPage::displayRequested, this, [this] { showDisplay(); });
    connect(m_displayPage, &DisplayPage::backRequested, this, &MainWindow::leaveDisplay);
    connect(m_displayPage, &DisplayPage::chosen, this, [this](const QString& specification) {
        m_rehearses = false;
        useDisplay(specification.toStdString());
    });
    connect(m_displayPage, &DisplayPage::rehearsalRequested, this, [this] {
        m_rehearses = true;
        useDisplay("none");
        const auto waiting = m_waiting;
        leaveDisplay();
        if (waiting) showingFaults(*m_studyPage, [&] { requestSession(*waiting); });
    });
    connect(m_sessionPage, &SessionPage::patternRequested, this, [this](const std::optional<TestPattern>& pattern) {
        if (m_session) m_session->showPattern(pattern, rememberedScale(m_options.settings.get(), m_options.display));
    });
}

void MainWindow::useDisplay(const std::string& specification)
{
    m_options.display = specification;
    m_options.operatedBy.plainImages = leavesPlainImages(specification);
}

void MainWindow::showDisplay(const QString& why)
{
    m_displayPage->present(m_options.display, why);
    m_pages->setCurrentWidget(m_displayPage);
    m_displayPage->focusFirst();
}

void MainWindow::connectKeysPages()
{
    connect(m_startPage, &StartPage::keysRequested, this, &MainWindow::showKeys);
    connect(m_studyPage, &StudyPage::keysRequested, this, &MainWindow::showKeys);
    connect(m_keysPage, &KeysPage::backRequested, this, &MainWindow::leaveDisplay);
    connect(m_latencyPage, &LatencyPage::backRequested, this, &MainWindow::showKeys);
    connect(m_keysPage, &KeysPage::latencyTaskRequested, this, [this] {
        m_latencyPage->present(QString::fromStdString(m_options.operatedBy.operatorName));
        m_pages->setCurrentWidget(m_latencyPage);
        m_latencyPage->focusFirst();
    });
    connect(m_latencyPage, &LatencyPage::measured, this, [this](const database::OperatorLatency& run) {
        showingFaults(*m_latencyPage, [&] {
            m_study->storeLatency(run);
            m_latencyPage->showStored(run);
        });
    });
}

void MainWindow::connectParticipantSide()
{
    auto* shortcut = new QShortcut(QKeySequence(Qt::Key_F4), this);
    shortcut->setAutoRepeat(false);
    connect(shortcut, &QShortcut::activated, this, &MainWindow::showParticipantSide);
    connect(m_startPage, &StartPage::participantRequested, this, &MainWindow::showParticipantSide);
    connect(m_studyPage, &StudyPage::participantRequested, this, &MainWindow::showParticipantSide);
    connect(m_participantPage, &ParticipantPage::backRequested, this, &MainWindow::leaveParticipantSide);
    connect(&participantSide(), &ParticipantSide::acted, this, &MainWindow::takeAct);
    tellParticipant();
}

void MainWindow::showParticipantSide()
{
    if (m_pages->currentWidget() == m_participantPage) return leaveParticipantSide();
    m_beforeParticipantPage = m_pages->currentWidget();
    m_participantPage->present();
    m_pages->setCurrentWidget(m_participantPage);
    m_participantPage->focusFirst();
}

void MainWindow::leaveParticipantSide()
{
    m_pages->setCurrentWidget(m_beforeParticipantPage);
    if (m_session) m_sessionPage->present(m_session->view(), m_session->canCorrect());
}

void MainWindow::tellParticipant() { m_participantRoom->tell(m_study.get(), m_session.get()); }

void MainWindow::takeAct(const participant::ParticipantAct& act)
{
    if (!m_session) return;
    if (m_participantRoom->take(act, *m_session)) m_sessionPage->holdKeys();
    m_sessionPage->showAct(act);
}

void MainWindow::showKeys()
{
    m_keysPage->present();
    m_keysPage->offerLatencyTask(m_study != nullptr);
    m_pages->setCurrentWidget(m_keysPage);
    m_keysPage->focusFirst();
}

void MainWindow::leaveDisplay()
{
    m_waiting.reset();
    if (m_isRehearsing)
        showRehearsal();
    else if (m_study)
        showStudy();
    else
        showStart();
}

void MainWindow::connectTools()
{
    connect(m_studyPage, &StudyPage::toolsRequested, this, [this] {
        m_toolsPage->present(m_study->store().folder().folder);
        m_pages->setCurrentWidget(m_toolsPage);
        m_toolsPage->focusFirst();
    });
    connect(m_toolsPage, &ToolsPage::backRequested, this, &MainWindow::showStudy);
    connect(m_toolsPage, &ToolsPage::monitorRequested, this, [this] { showingFaults(*m_toolsPage, [&] { openMonitor(); }); });
}

void MainWindow::connectRehearsal()
{
    m_studyPage->offerRehearsal(static_cast<bool>(m_options.makeRehearsal));
    connect(m_studyPage, &StudyPage::rehearsalRequested, this, [this] {
        m_isRehearsing = true;
        m_rehearsalPage->begin(m_study->codesOnPieces());
        showRehearsal();
    });
    connect(m_rehearsalPage, &RehearsalPage::checksRequested, this, [this] { m_rehearsalPage->refresh(room()); });
    connect(m_rehearsalPage, &RehearsalPage::displayRequested, this, [this] { showDisplay(); });
    connect(m_rehearsalPage, &RehearsalPage::sessionRequested, this,
            [this] { showingFaults(*m_rehearsalPage, [&] { playRehearsal(); }); });
    connect(m_rehearsalPage, &RehearsalPage::backRequested, this, [this] {
        m_isRehearsing = false;
        showStudy();
    });
}

RehearsalPage::Room MainWindow::room()
{
    const StudyOverview overview = m_study->overview();
    RehearsalPage::Room room{overview.nextParticipant, {}, m_study->codesOnPieces(), {}, {}};
    showingFaults(*m_rehearsalPage, [&] {
        const auto display = m_options.openDisplay(m_options.display);
        if (display->isThere()) room.displayName = QString::fromStdString(display->name());
    });
    room.diskFault = faultOfDisk(m_study->store().folder().folder);
    room.clockFault = faultOfClocks(m_study->lastWallTime());
    return room;
}

void MainWindow::showRehearsal()
{
    m_rehearsalPage->refresh(room());
    m_pages->setCurrentWidget(m_rehearsalPage);
    m_rehearsalPage->focusFirst();
}

void MainWindow::playRehearsal()
{
    m_session.reset();
    m_rehearsal.reset();
    m_rehearsalFolder = m_options.makeRehearsal(m_study->store().folder().folder);
    m_rehearsal = std::make_unique<OpenStudy>(*m_rehearsalFolder);
    try {
        begin(*m_rehearsal, protocols::ParticipantId(rehearsalParticipant), m_options.openDisplay(m_options.display));
    } catch (...) {
        m_session.reset();
        m_rehearsal.reset();  // a later session is of the study again
        m_rehearsalFolder.reset();
        throw;
    }
}

void MainWindow::openMonitor()
{
    if (!m_monitor) m_monitor = std::make_unique<MonitorWindow>(m_study->store().folder().folder, m_options);
    m_monitor->show();
    m_monitor->raise();
    m_monitor->activateWindow();
}

QWidget* MainWindow::currentPage() const { return m_pages->currentWidget(); }

ParticipantSide& MainWindow::participantSide() const { return m_participantRoom->side(); }

ParticipantSound& MainWindow::participantSound() const { return m_participantRoom->sound(); }

void MainWindow::showStart()
{
    setWindowTitle(tr("Vis2Hap"));
    m_startPage->present(recentStudies(m_options.settings.get()),
                         {static_cast<bool>(m_options.makeStudy), static_cast<bool>(m_options.lookAtData),
                          static_cast<bool>(m_options.photographs)});
    m_pages->setCurrentWidget(m_startPage);
    m_startPage->focusFirst();
}

void MainWindow::openStudy(const std::filesystem::path& folder)
{
    auto opened = std::make_unique<OpenStudy>(folder);
    m_session.reset();
    m_monitor.reset();
    m_study = std::move(opened);
    const auto whole = std::filesystem::absolute(folder).lexically_normal();
    rememberStudy(m_options.settings.get(), QString::fromStdString(whole.string()));
    showStudy();
}

void MainWindow::showStudy()
{
    setWindowTitle(tr("%1 – Vis2Hap").arg(m_study->name()));
    m_studyPage->present(m_study->overview(), m_options.kind);
    if (const QString fault = m_study->protocolFault(); !fault.isEmpty()) m_studyPage->showFault(fault);
    m_pages->setCurrentWidget(m_studyPage);
    m_studyPage->focusFirst();
}

void MainWindow::closeStudy()
{
    m_session.reset();
    m_monitor.reset();
    m_study.reset();
    showStart();
    tellParticipant();
}

void MainWindow::startSession(const protocols::ParticipantId& participant)
{
    m_session.reset();  // A driver serves one connection at a time.
    begin(*m_study, participant, m_options.openDisplay(m_options.display));
}

void MainWindow::requestSession(const protocols::ParticipantId& participant)
{
    m_session.reset();
    auto display = m_options.openDisplay(m_options.display);
    if (display->isThere() || m_rehearses || m_options.kind != database::ParticipantKind::Human)
        return begin(*m_study, participant, std::move(display));
    display.reset();
    showDisplay(tr("No display is connected, so %1 would feel nothing. Connect a display, or rehearse without one.")
                    .arg(QString::fromStdString(participant.value)));
    m_waiting = participant;
}

void MainWindow::begin(OpenStudy& study, const protocols::ParticipantId& participant,
                       std::unique_ptr<rendering::HapticDisplay> display)
{
    m_session = std::make_unique<SessionController>(study.store(), participant, study.bank(), std::move(display), m_options.clock,
                                                    m_options.kind, m_options.operatedBy, nullptr);
    m_leavingWasRefused = false;
    connectSession();
    SessionFacts facts = m_session->facts();
    facts.isRehearsal = &study == m_rehearsal.get();
    facts.keys = m_keysPage->keys();
    facts.mmPerPixel = rememberedScale(m_options.settings.get(), m_options.display);
    m_sessionPage->begin(facts);
    m_pages->setCurrentWidget(m_sessionPage);
    setWindowTitle(tr("%1 – %2 – Vis2Hap").arg(QString::fromStdString(participant.value), study.name()));
    m_sessionPage->present(m_session->view(), m_session->canCorrect());
    m_participantRoom->begin(*m_session);
    tellParticipant();
}

void MainWindow::connectSession()
{
    connect(m_session.get(), &SessionController::viewChanged, this, &MainWindow::refreshSession);
    connect(m_session.get(), &SessionController::reported, m_sessionPage, &SessionPage::showMessage);
    connect(m_session.get(), &SessionController::patternShown, m_sessionPage, &SessionPage::showPattern);
}

void MainWindow::refreshSession()
{
    // When the display fails, the event is stored nevertheless. A touch that the display reports, or an act of the participant,
    // can come at any time, so it must not close a panel that the operator is using.
    const auto& outcome = m_session->lastOutcome();
    const bool isByOperator = !m_participantRoom->isTaking() && session::isEnteredByOperator(outcome->event);
    const bool isAccepted = !outcome->refusal && !outcome->fault;
    if (isByOperator && (isAccepted || m_sessionPage->shownView().state != m_session->view().state))
        m_sessionPage->closePanelAndMessage();
    m_sessionPage->present(m_session->view(), m_session->canCorrect());
    tellParticipant();
}

bool MainWindow::pauseForLeaving()
{
    const session::State& state = m_session->view().state;
    const bool isOver =
        std::holds_alternative<session::Finished>(state.stage) || std::holds_alternative<session::Withdrawn>(state.stage);
    if (state.paused || isOver) return true;
    m_session->send(session::Paused{});
    if (!m_session->lastOutcome()->fault || m_leavingWasRefused) return true;
    m_leavingWasRefused = true;
    return false;
}

void MainWindow::leaveSession()
{
    if (!m_session || !pauseForLeaving()) return;
    const bool isFinished = std::holds_alternative<session::Finished>(m_session->view().state.stage);
    m_session.reset();
    if (m_rehearsal) {
        m_rehearsal.reset();
        m_rehearsalFolder.reset();
        m_rehearsalPage->sessionLeft(isFinished);
        showRehearsal();
    } else {
        showStudy();
    }
    tellParticipant();
}

void MainWindow::closeEvent(QCloseEvent* event)
{
    if (m_session && !pauseForLeaving()) {
        event->ignore();
        return;
    }
    m_monitor.reset();  // an open monitor would keep the program running
    m_participantPage->closeWindow();
    QWidget::closeEvent(event);
}

void MainWindow::keyPressEvent(QKeyEvent* event)
{
    // Handles the keys of the session page when none of its controls has the focus.
    if (m_pages->currentWidget() == m_sessionPage && event->modifiers() == Qt::NoModifier && !event->isAutoRepeat() &&
        m_sessionPage->pressKey(event->key()))
        return;
    QWidget::keyPressEvent(event);
}

}  // namespace study::app
