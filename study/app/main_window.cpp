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
#include "study/app/pages/setup/connecting_page.h"
#include "study/app/pages/setup/display_page.h"
#include "study/app/pages/setup/keys_page.h"
#include "study/app/pages/setup/latency_page.h"
#include "study/app/pages/setup/participant_page.h"
#include "study/app/pages/setup/rehearsal_page.h"
#include "study/app/pages/setup/room_checks.h"
#include "study/app/pages/start_page.h"
#include "study/app/pages/study_page.h"
#include "study/app/pages/tools/tools_page.h"
#include "study/app/participant_room.h"
#include "study/app/server_bar.h"
#include "study/app/state/recent_studies.h"
#include "study/app/stray_keys.h"
#include "study/app/window_pages.h"

namespace study::app {

namespace {

/// Runs `work` and shows its fault on `page`, where the operator asked for it.
template <class Page, class Work>
void showingFaults(Page& page, Work work)
{
    try {
        work();
    } catch (const std::exception& fault) {
        page.showFault(inOwnLanguage(fault.what()));
    }
}

QString faultText(const std::exception_ptr& fault)
{
    try {
        std::rethrow_exception(fault);
    } catch (const std::exception& thrown) {
        return inOwnLanguage(thrown.what());
    }
}

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
      m_opening(options.openDisplay),
      m_participantRoom(new ParticipantRoom(this)),
      m_pages(new WindowPages(m_options, *m_participantRoom, this)),
      m_strayKeys(new StrayKeys(*this, *m_pages, m_options.clock)),
      m_serverBar(new ServerBar(this))
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
    m_rehearses = options.isDisplayGiven && options.display == "none";
    const std::string remembered = rememberedDisplay(options.settings.get());
    const bool isAllowed = options.allowsPlainImages || !leavesPlainImages(remembered);
    const bool isWanted = !options.isDisplayGiven && options.kind == database::ParticipantKind::Human && !remembered.empty();
    if (isWanted && isAllowed) useDisplay(remembered);
    connectPages();
    connectDisplayPage();
    connectKeysPages();
    m_pages->study->offerTools(static_cast<bool>(options.useTool));
    connectTools();
    connectParticipantSide();
    connectRehearsal();
    connect(new QShortcut(QKeySequence(Qt::CTRL | Qt::Key_Q), this), &QShortcut::activated, this, [this] { close(); });
    showStart();
    if (!m_options.languageFault.isEmpty()) m_pages->start->showFault(m_options.languageFault);
    if (isWanted && !isAllowed)
        m_pages->start->showFault(
            tr("The display of the last time, %1, is not connected: an operator could open its plain images. Choose "
               "another display here, or start the program with --plain-images.")
                .arg(QString::fromStdString(remembered)));
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
    connect(m_pages->session, &SessionPage::correctionRequested, this,
            [this] { m_pages->session->openCorrection(m_session->correctables()); });
    connect(m_pages->session, &SessionPage::eventRequested, this, [this](const session::EventBody& event) {
        if (m_session) m_session->send(event);
    });
    connect(m_pages->session, &SessionPage::hintShown, this, [this] {
        if (m_session) m_session->pageAsked();
    });
    connect(m_pages->session, &SessionPage::answerMarked, this, [this](AnswerMark mark) {
        if (!m_session) return;
        if (mark == AnswerMark::Emptied)
            m_session->unmarkEntry();
        else
            m_session->markAnswerBegun(mark == AnswerMark::Spoken ? session::BegunBy::Spoken : session::BegunBy::Entry);
    });
    // Queued, so that the page is not rebuilt while it still handles its own event.
    connect(m_pages->session, &SessionPage::leaveRequested, this, &MainWindow::leaveSession, Qt::QueuedConnection);
}

void MainWindow::connectDisplayPage()
{
    connect(m_pages->start, &StartPage::displayRequested, this, [this] { showDisplay(); });
    connect(m_pages->study, &StudyPage::displayRequested, this, [this] { showDisplay(); });
    connect(m_pages->display, &DisplayPage::backRequested, this, &MainWindow::leaveDisplay);
    connect(m_pages->connecting, &ConnectingPage::stopRequested, this, &MainWindow::stopConnecting);
    connect(m_pages->display, &DisplayPage::chosen, this, [this](const QString& specification) {
        m_rehearses = false;
        useDisplay(specification.toStdString());
    });
    connect(m_pages->display, &DisplayPage::rehearsalRequested, this, [this] {
        m_rehearses = true;
        useDisplay("none");
        const auto waiting = m_waiting;
        leaveDisplay();
        if (waiting) requestSession(*waiting, m_waitingEnrolment);
    });
    connect(m_pages->session, &SessionPage::patternRequested, this, [this](const std::optional<TestPattern>& pattern) {
        if (m_session) m_session->showPattern(pattern, rememberedScale(m_options.settings.get(), m_options.display));
    });
}

void MainWindow::connectDisplay(DisplayOpening::Opened use, DisplayOpening::Failed failed)
{
    m_stopped = failed;
    m_opening.open(m_options.display, std::move(use), std::move(failed));
    if (!m_opening.isOpening()) return;
    m_pages->setCurrentWidget(m_pages->connecting);
    m_pages->connecting->present(QString::fromStdString(m_options.display));
}

void MainWindow::stopConnecting()
{
    m_opening.stop();
    if (m_stopped) m_stopped(tr("Connecting the display was stopped."));
}

void MainWindow::useDisplay(const std::string& specification)
{
    m_options.display = specification;
    m_options.operatedBy.plainImages = leavesPlainImages(specification);
}

void MainWindow::showDisplay(const QString& why)
{
    m_pages->display->present(m_options.display, why);
    m_pages->bring(*m_pages->display);
}

void MainWindow::connectKeysPages()
{
    connect(m_pages->start, &StartPage::keysRequested, this, &MainWindow::showKeys);
    connect(m_pages->study, &StudyPage::keysRequested, this, &MainWindow::showKeys);
    connect(m_pages->keys, &KeysPage::backRequested, this, &MainWindow::leaveDisplay);
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
    connect(&participantSide(), &ParticipantSide::acted, this, &MainWindow::takeAct);
    connect(&participantSound(), &ParticipantSound::stateChanged, this, &MainWindow::showSoundFault);
    tellParticipant();
}

void MainWindow::showSoundFault()
{
    const QString fault = participantSound().state().fault;
    const bool isNew = std::exchange(m_soundFault, fault) != fault;
    if (m_session && isNew && !fault.isEmpty())
        m_pages->session->showMessage(tr("%1. F4 opens the page of the headphones.").arg(fault), Tone::Fault);
}

void MainWindow::showParticipantSide()
{
    if (m_pages->currentWidget() == m_pages->participant) return leaveParticipantSide();
    if (m_opening.isOpening()) return;  // another page comes by itself in a moment
    m_beforeParticipantPage = m_pages->currentWidget();
    m_pages->participant->present();
    m_pages->bring(*m_pages->participant);
}

void MainWindow::leaveParticipantSide()
{
    m_pages->setCurrentWidget(m_beforeParticipantPage);
    if (!m_session) return;
    m_session->refresh();  // else the clock of a break would stand at its last event
    m_pages->session->present(m_session->view(), m_session->canCorrect());
}

void MainWindow::tellParticipant() { m_participantRoom->tell(m_study.get(), m_session.get()); }

void MainWindow::takeAct(const participant::ParticipantAct& act)
{
    if (!m_session) return;
    const int sentBefore = m_session->eventsSent();
    if (m_participantRoom->take(act, *m_session)) m_pages->session->holdKeys();
    const auto& outcome = m_session->lastOutcome();
    const bool isStored = m_session->eventsSent() > sentBefore && !outcome->refusal && !outcome->fault;
    const auto* agreement = std::get_if<participant::Agreement>(&act.what);
    const bool isDisagreement = agreement && !agreement->agrees;  // the operator must know it, stored or not
    if (isStored || isDisagreement) m_pages->session->showAct(act);
}

void MainWindow::showKeys()
{
    m_pages->keys->present();
    m_pages->keys->offerLatencyTask(m_study != nullptr);
    m_pages->bring(*m_pages->keys);
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
    connect(m_pages->study, &StudyPage::toolsRequested, this, [this] {
        m_pages->tools->present(m_study->store().folder().folder);
        m_pages->bring(*m_pages->tools);
    });
    connect(m_pages->tools, &ToolsPage::backRequested, this, &MainWindow::showStudy);
    connect(m_pages->tools, &ToolsPage::monitorRequested, this,
            [this] { showingFaults(*m_pages->tools, [&] { openMonitor(m_study->store().folder().folder); }); });
}

void MainWindow::connectRehearsal()
{
    m_pages->study->offerRehearsal(static_cast<bool>(m_options.makeRehearsal));
    connect(m_pages->study, &StudyPage::rehearsalRequested, this, [this] {
        m_isRehearsing = true;
        m_pages->rehearsal->begin(m_study->codesOnPieces());
        showRehearsal();
    });
    connect(m_pages->rehearsal, &RehearsalPage::checksRequested, this, &MainWindow::showRehearsal);
    connect(m_pages->rehearsal, &RehearsalPage::displayRequested, this, [this] { showDisplay(); });
    connect(m_pages->rehearsal, &RehearsalPage::sessionRequested, this, [this] {
        m_session.reset();  // A driver serves one connection at a time.
        connectDisplay(
            [this](auto display) {
                m_pages->setCurrentWidget(m_pages->rehearsal);
                showingFaults(*m_pages->rehearsal, [&] { playRehearsal(std::move(display)); });
            },
            [this](const QString& fault) {
                m_pages->setCurrentWidget(m_pages->rehearsal);
                m_pages->rehearsal->showFault(fault);
            });
    });
    connect(m_pages->rehearsal, &RehearsalPage::backRequested, this, [this] {
        m_isRehearsing = false;
        showStudy();
    });
}

void MainWindow::showRehearsal()
{
    connectDisplay(
        [this](auto display) {
            const QString name = display->isThere() ? QString::fromStdString(display->name()) : QString();
            display.reset();  // The session connects it again.
            presentRehearsal(name);
        },
        [this](const QString& fault) {
            presentRehearsal({});
            m_pages->rehearsal->showFault(fault);
        });
}

void MainWindow::presentRehearsal(const QString& displayName)
{
    m_pages->rehearsal->refresh({m_study->overview().nextParticipant, displayName, m_study->codesOnPieces(),
                                 faultOfDisk(m_study->store().folder().folder), faultOfClocks(m_study->lastWallTime())});
    if (m_pages->currentWidget() == m_pages->rehearsal) return;
    m_pages->bring(*m_pages->rehearsal);
}

void MainWindow::playRehearsal(std::unique_ptr<rendering::HapticDisplay> display)
{
    m_session.reset();
    m_rehearsal.reset();
    m_rehearsalFolder = m_options.makeRehearsal(m_study->store().folder().folder);
    m_rehearsal = std::make_unique<OpenStudy>(*m_rehearsalFolder);
    try {
        begin(*m_rehearsal, protocols::ParticipantId(rehearsalParticipant), std::move(display));
    } catch (...) {
        m_session.reset();
        m_rehearsal.reset();  // a later session is of the study again
        m_rehearsalFolder.reset();
        throw;
    }
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
    m_session.reset();
    m_monitor.reset();
    m_study = std::move(opened);
    const auto whole = std::filesystem::absolute(folder).lexically_normal();
    rememberStudy(m_options.settings.get(), QString::fromStdString(whole.string()));
    tellParticipant();
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

void MainWindow::showServerLink()
{
    const auto link = m_study ? m_study->serverLink() : std::nullopt;
    m_serverBar->present(link);
    // Queued, because the session may be the one that asks.
    if (link && !link->stale.empty() && m_session && !m_rehearsal)
        QMetaObject::invokeMethod(this, &MainWindow::leaveStaleSession, Qt::QueuedConnection);
}

void MainWindow::leaveStaleSession()
{
    const auto link = m_study ? m_study->serverLink() : std::nullopt;
    if (!link || link->stale.empty() || !m_session) return;
    m_session.reset();
    m_study->leaveParticipant();
    m_strayKeys->holdEnterOfStudy();
    tellParticipant();
    showingFaults(*m_pages->study, [this] { showStudy(); });
    showStudyFault(inOwnLanguage(link->stale));
}

void MainWindow::closeStudy()
{
    m_session.reset();
    m_monitor.reset();
    m_study.reset();
    showServerLink();
    showStart();
    tellParticipant();
}

void MainWindow::startSession(const protocols::ParticipantId& participant)
{
    m_session.reset();  // A driver serves one connection at a time.
    begin(*m_study, participant, m_options.openDisplay(m_options.display, {}));
}

void MainWindow::beginRequested(const protocols::ParticipantId& participant, Enrolment enrolment,
                                std::unique_ptr<rendering::HapticDisplay> display)
{
    try {
        if (enrolment == Enrolment::NewOnly) m_study->enrolNew(participant, m_options.kind);
        begin(*m_study, participant, std::move(display));
    } catch (const std::exception& fault) {
        m_session.reset();
        m_study->leaveParticipant();
        showStudyFault(inOwnLanguage(fault.what()));
    }
}

void MainWindow::requestSession(const protocols::ParticipantId& participant, Enrolment enrolment)
{
    m_session.reset();
    const auto use = [this, participant, enrolment](std::unique_ptr<rendering::HapticDisplay> display) {
        if (display->isThere() || m_rehearses || m_options.kind != database::ParticipantKind::Human)
            return beginRequested(participant, enrolment, std::move(display));
        display.reset();
        showDisplay(tr("No display is connected, so %1 would feel nothing. Connect a display, or rehearse without one.")
                        .arg(QString::fromStdString(participant.value)));
        m_waiting = participant;
        m_waitingEnrolment = enrolment;
    };
    connectDisplay(use, [this](const QString& fault) { showStudyFault(fault); });
}

void MainWindow::showStudyFault(const QString& text)
{
    if (m_pages->currentWidget() != m_pages->study) {
        m_pages->bring(*m_pages->study);
    }
    m_pages->study->showFault(text);
}

void MainWindow::begin(OpenStudy& study, const protocols::ParticipantId& participant,
                       std::unique_ptr<rendering::HapticDisplay> display)
{
    m_session = std::make_unique<SessionController>(study.store(), participant, study.images(), std::move(display),
                                                    m_options.clock, m_options.kind, m_options.operatedBy, nullptr);
    m_leavingWasRefused = false;
    connectSession();
    SessionFacts facts = m_session->facts();
    facts.isRehearsal = &study == m_rehearsal.get();
    facts.keys = m_pages->keys->keys();
    facts.mmPerPixel = rememberedScale(m_options.settings.get(), m_options.display);
    m_pages->session->begin(facts);
    m_pages->setCurrentWidget(m_pages->session);
    setWindowTitle(facts.isRehearsal ? tr("Rehearsal – %1 – Vis2Hap").arg(m_study->name())
                                     : tr("%1 – %2 – Vis2Hap").arg(QString::fromStdString(participant.value), study.name()));
    m_pages->session->present(m_session->view(), m_session->canCorrect());
    m_participantRoom->begin(*m_session);
    tellParticipant();
    m_soundFault.clear();  // a fault from before the session matters in it, too
    showSoundFault();
}

void MainWindow::connectSession()
{
    connect(m_session.get(), &SessionController::viewChanged, this, &MainWindow::refreshSession);
    connect(m_session.get(), &SessionController::reported, m_pages->session, &SessionPage::showMessage);
    connect(m_session.get(), &SessionController::patternShown, m_pages->session, &SessionPage::showPattern);
}

void MainWindow::refreshSession()
{
    // When the display fails, the event is stored nevertheless. A touch or a fault that the display reports, or an act of the
    // participant, can come at any time, so it must not close a panel that the operator is using.
    const auto& outcome = m_session->lastOutcome();
    const bool isByDisplay = outcome->cause == Cause::DisplayFault;
    const bool isByOperator = outcome->cause == Cause::Usual && session::isEnteredByOperator(outcome->event);
    const bool isAccepted = !outcome->refusal && !outcome->fault;
    const bool hasMovedOn = m_pages->session->shownView().state != m_session->view().state;
    if (isByOperator && (isAccepted || hasMovedOn)) m_pages->session->closePanelAndMessage();
    if (isByDisplay && hasMovedOn) m_pages->session->holdKeys(SessionPage::MovedBy::Display);
    m_pages->session->present(m_session->view(), m_session->canCorrect());
    tellParticipant();
    showServerLink();
}

bool MainWindow::pauseForLeaving()
{
    const session::State& state = m_session->view().state;
    const bool isOver =
        std::holds_alternative<session::Finished>(state.stage) || std::holds_alternative<session::Withdrawn>(state.stage);
    if (state.paused || isOver) return true;
    m_session->send(session::Paused{});
    const std::exception_ptr fault = m_session->lastOutcome()->fault;
    if (!fault || m_leavingWasRefused) return true;
    m_leavingWasRefused = true;
    m_pages->setCurrentWidget(m_pages->session);
    m_pages->session->showMessage(tr("%1. The pause was not stored, so the session is still open. Fix the problem, or leave once "
                                     "more: no stored answer is lost.")
                                      .arg(faultText(fault)),
                                  Tone::Fault);
    return false;
}

void MainWindow::leaveSession()
{
    if (!m_session || !pauseForLeaving()) return;
    const bool isFinished = std::holds_alternative<session::Finished>(m_session->view().state.stage);
    m_session.reset();
    m_strayKeys->holdEnterOfStudy();
    if (m_rehearsal) {
        m_rehearsal.reset();
        m_rehearsalFolder.reset();
        m_pages->rehearsal->sessionLeft(isFinished);
        showRehearsal();
    } else {
        m_study->leaveParticipant();
        showStudy();
    }
    tellParticipant();
}

void MainWindow::closeEvent(QCloseEvent* event)
{
    if (m_session && !m_pages->session->mayClose()) {
        m_pages->setCurrentWidget(m_pages->session);
        event->ignore();
        return;
    }
    if (m_session && !pauseForLeaving()) {
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
