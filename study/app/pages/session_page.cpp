#include "study/app/pages/session_page.h"

#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QShortcut>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "study/app/language/app_text.h"
#include "study/app/pages/checklist_page.h"
#include "study/app/pages/correction_panel.h"
#include "study/app/pages/guide_page.h"
#include "study/app/pages/reason_panel.h"
#include "study/app/pages/stage_stack.h"
#include "study/app/pages/tray_page.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/session_footer.h"
#include "study/app/pieces/session_header.h"

namespace study::app {

using namespace session;

namespace {

QString refusedConsent() { return SessionPage::tr("The participant does not agree. Speak with them. W ends the session."); }

}  // namespace

SessionPage::SessionPage(QWidget* parent)
    : QWidget(parent),
      m_header(new SessionHeader(this)),
      m_stages(new StageStack(this)),
      m_message(new MessageBar("sessionMessage", this)),
      m_guard(new QWidget(this)),
      m_footer(new SessionFooter(this))
{
    setObjectName("sessionPage");
    setFocusPolicy(Qt::ClickFocus);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(m_header);
    column->addWidget(m_stages, 1);
    column->addWidget(m_guard);
    column->addWidget(m_footer);
    connect(m_stages, &StageStack::eventRequested, this, &SessionPage::request);
    connect(m_stages, &StageStack::answerMarked, this, &SessionPage::answerMarked);
    connect(m_stages, &StageStack::patternRequested, this, &SessionPage::patternRequested);
    connect(m_stages, &StageStack::hinted, this, [this](const QString& text) {
        showMessage(text, Tone::Hint);
        if (!text.isEmpty()) Q_EMIT hintShown();
    });
    connect(m_stages, &StageStack::mended, this, &SessionPage::clearMendedMessage);
    connect(m_stages, &StageStack::messageHidden, this, &SessionPage::pinMessage);
    connect(m_stages, &StageStack::panelCloseRequested, this, &SessionPage::closePanel);
    connect(&m_stages->guide(), &GuidePage::leaveRequested, this, &SessionPage::leave);
    connect(&m_stages->guide(), &GuidePage::preparationDeclined, this, &SessionPage::goOnUnprepared);
    connectPanels();
    fillGuard();
    bindKeysWhileWriting();
    qApp->installEventFilter(this);
}

void SessionPage::connectPanels()
{
    ReasonPanel& reason = m_stages->reason();
    const auto onAsking = [this, &reason](auto asked, auto ask) {
        connect(m_footer, asked, this, [this, &reason, ask] {
            ask();
            openPanel(reason);
        });
    };
    onAsking(&SessionFooter::noteRequested, [&reason] { reason.askForNote(); });
    onAsking(&SessionFooter::flagRequested, [this, &reason] { reason.askForFlag(codeMeant()); });
    onAsking(&SessionFooter::voidRequested, [this, &reason] { reason.askWhyVoid(codeMeant()); });
    onAsking(&SessionFooter::withdrawRequested, [&reason] { reason.askWhyWithdrawn(); });
    connect(m_footer, &SessionFooter::correctionRequested, this, &SessionPage::correctionRequested);
    connect(m_footer, &SessionFooter::pauseRequested, this, [this] { Q_EMIT eventRequested(Paused{}); });
    connect(m_footer, &SessionFooter::leaveRequested, this, &SessionPage::leave);
}

void SessionPage::fillGuard()
{
    m_guard->setObjectName("closeGuard");
    auto* question = label("guardQuestion", Type::Body, m_guard, Weight::Bold);
    setRole(*question, "hint");
    question->setText(tr("Your text is not stored yet. Store it first, or go on without it."));
    auto* give = button("closeAnywayButton", tr("Go on without storing"), m_guard);
    auto* stayHere = button("stayButton", tr("Stay (Esc)"), m_guard);
    auto* column = new QVBoxLayout(m_guard);
    column->setContentsMargins(28, 8, 28, 8);
    column->addWidget(question);
    column->addLayout(actionsRow({stayHere, give}));
    connect(stayHere, &QPushButton::clicked, this, &SessionPage::stay);
    connect(give, &QPushButton::clicked, this, &SessionPage::goOnWithoutText);
    m_guard->hide();
}

bool SessionPage::hasUnstoredText() const
{
    return (m_panel && m_panel->hasUnstoredText()) || m_stages->pageOf(m_view.state.stage).hasUnstoredText();
}

bool SessionPage::mayGoOn(GoingOn goingOn)
{
    if (m_isTextGivenUp || !hasUnstoredText()) return true;
    m_goingOn = goingOn;
    m_guard->show();
    m_guard->findChild<QPushButton*>("stayButton")->setFocus();
    return false;
}

void SessionPage::stay()
{
    m_guard->hide();
    pageInFront().firstFocus().setFocus();
}

bool SessionPage::mayClose() { return mayGoOn(GoingOn::Close); }

void SessionPage::leave()
{
    if (mayGoOn(GoingOn::Leave)) Q_EMIT leaveRequested();
}

void SessionPage::goOnWithoutText()
{
    m_guard->hide();
    if (m_goingOn == GoingOn::Leave) {
        Q_EMIT leaveRequested();
        return;
    }
    m_isTextGivenUp = true;
    window()->close();
    m_isTextGivenUp = false;  // the window stays open if its pause cannot be stored
}

void SessionPage::bindKeysWhileWriting()
{
    // In a text field letters are text, and those of the slots are answers. With Alt they work as command keys.
    for (const int key : {Qt::Key_T, Qt::Key_L, Qt::Key_N, Qt::Key_F, Qt::Key_V, Qt::Key_P, Qt::Key_W, Qt::Key_Q, Qt::Key_G}) {
        auto* shortcut = new QShortcut(QKeySequence(Qt::ALT | key), this);
        shortcut->setContext(Qt::WidgetWithChildrenShortcut);
        shortcut->setAutoRepeat(false);
        connect(shortcut, &QShortcut::activated, this, [this, key] { pressCommand(key); });
    }
}

QString SessionPage::codeMeant() const
{
    const auto* tray = std::get_if<PlacingTray>(&m_view.state.stage);
    const auto& answers = m_view.state.answers;
    const bool isUnbegun =
        tray && std::none_of(answers.begin(), answers.end(), [&](const auto& answer) { return answer.index == tray->index; });
    return isUnbegun ? QString() : QString::fromStdString(m_view.code.value);
}

void SessionPage::begin(const SessionFacts& facts)
{
    m_hasDisagreed = m_isConsentAsked = false;
    closePanel();
    m_facts = facts;
    m_view = {};
    m_isPreparationDeclined = false;
    m_message->clearMessage();
    m_header->begin(facts);
    m_footer->setKeys(facts.keys);
    m_stages->begin(facts);
}

bool SessionPage::offersPreparation() const
{
    const Stage& stage = m_view.state.stage;
    const bool isBetweenPresentations = std::holds_alternative<PlacingTray>(stage) || std::holds_alternative<OnBreak>(stage);
    const bool hasSomething = m_facts.scale || !m_facts.checklist.isEmpty() || !m_facts.readings.isEmpty();
    return isBetweenPresentations && hasSomething && !m_view.sittingIsPrepared && !m_isPreparationDeclined;
}

void SessionPage::present(const View& view, bool canCorrect)
{
    m_view = view;
    if (m_hasDisagreed && !std::holds_alternative<Consenting>(view.state.stage)) {
        m_hasDisagreed = false;
        m_message->clearMessage();
    }
    m_header->present(view);
    m_footer->present(view, canCorrect);
    m_stages->guide().offerPreparation(offersPreparation());
    if (std::holds_alternative<Presenting>(view.state.stage)) m_stages->tray().setPlaced(view.tray);
    StagePage& page = pageOf(view);
    page.present(view);
    if (!m_panel) bringForward(page);
}

void SessionPage::goOnUnprepared()
{
    m_isPreparationDeclined = true;
    if (m_view.state.paused)
        Q_EMIT eventRequested(Resumed{});
    else
        present(View(m_view), m_footer->canCorrect());
}

StagePage& SessionPage::pageOf(const View& view) const
{
    if (view.state.paused || offersPreparation()) return m_stages->guide();
    return m_stages->pageOf(view.state.stage);
}

StagePage& SessionPage::pageInFront() const { return m_panel ? *m_panel : pageOf(m_view); }

void SessionPage::bringForward(StagePage& page)
{
    m_guard->hide();
    page.take(*m_message);
    m_stages->bringForward(page);
    m_footer->setLettersTaken(m_panel ? 0 : page.lettersTaken());
}

void SessionPage::pinMessage()
{
    auto& column = static_cast<QVBoxLayout&>(*layout());
    column.insertWidget(column.indexOf(m_guard), m_message);
    m_message->show();
}

void SessionPage::openCorrection(const std::vector<Correctable>& answers)
{
    m_stages->correction().ask(answers);
    openPanel(m_stages->correction());
}

void SessionPage::openPanel(StagePage& panel)
{
    Q_EMIT patternRequested(std::nullopt);  // The panel hides the buttons of the patterns.
    m_panel = &panel;
    m_openedBy = m_lastKey;
    m_isConsentAsked = false;  // its question is no longer visible
    clearMessage();
    m_footer->setPanelOpen(true);
    bringForward(panel);
}

void SessionPage::closePanel()
{
    if (!m_panel) return;
    m_panel = nullptr;
    clearMessage();
    m_footer->setPanelOpen(false);
    bringForward(pageOf(m_view));
}

void SessionPage::closePanelAndMessage()
{
    clearMessage();
    m_panel = nullptr;
    m_footer->setPanelOpen(false);
}

void SessionPage::showPattern(const std::optional<TestPattern>& pattern)
{
    m_header->setPattern(pattern ? patternName(*pattern) : QString());
    m_stages->checklist().setPattern(pattern);
    m_header->present(m_view);
}

void SessionPage::clearMendedMessage()
{
    if (m_isMendable) clearMessage();
}

void SessionPage::clearMessage()
{
    if (m_hasDisagreed)
        showMessage({}, Tone::Fault);
    else
        m_message->clearMessage();
}

void SessionPage::showMessage(const QString& text, Tone tone)
{
    m_isMendable = tone == Tone::Hint || tone == Tone::Refusal;
    if (m_hasDisagreed) {
        QStringList sentences{refusedConsent()};
        if (!text.isEmpty()) sentences << text;
        m_message->showFault(sentencesTogether(sentences));
    } else if (tone == Tone::Done) {
        m_message->showDone(text);
    } else if (tone == Tone::Fault) {
        m_message->showFault(text);
    } else {
        m_message->showHint(text);
    }
    m_stages->showMessage(*m_message);
}

void SessionPage::request(const EventBody& event)
{
    if (m_hasDisagreed && std::holds_alternative<Consented>(event) && !std::exchange(m_isConsentAsked, true)) {
        showMessage(tr("If they agree now, press Enter once more."), Tone::Hint);
        Q_EMIT hintShown();
        return;
    }
    Q_EMIT eventRequested(event);
}

void SessionPage::pressCommand(int key)
{
    const StagePage& page = pageInFront();
    const bool isSlot = !page.isForWriting() && key >= Qt::Key_A && key < Qt::Key_A + page.lettersTaken();
    if (!m_footer->pressKey(key) && !isSlot) pageInFront().pressKey(key);
}

bool SessionPage::pressKey(int pressed)
{
    if (pressed == Qt::Key_Escape && m_guard->isVisible()) {
        stay();
        return true;
    }
    const int key = m_facts.keys.meantBy(pressed);
    if (key != pressed) {  // a pedal confirms what the page asks, whatever button has the focus, and is never a letter
        pressCommand(key);
        return true;
    }
    if (isEnter(key) && pressFocusedButton()) return true;
    return pageInFront().pressKey(key) || m_footer->pressKey(key) || m_stages->scrollBy(key);
}

bool SessionPage::pressFocusedButton() const
{
    // Enter triggers the main action of the page, but it presses a side button that has the focus.
    auto* focused = qobject_cast<QPushButton*>(focusWidget());
    const bool isSideButton = focused && focused->isVisible() && focused->isEnabled() && !focused->isCheckable() &&
                              focused->property("role").toString() != QLatin1String("main");
    if (isSideButton) focused->click();
    return isSideButton;
}

void SessionPage::keyPressEvent(QKeyEvent* event)
{
    const bool isPlain = (event->modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == 0;
    // A key held down must not run through several presentations.
    const bool isTaken = isPlain && (m_heldKeys.isRepeat(*event) || pressKey(event->key()));
    if (!isTaken) QWidget::keyPressEvent(event);
}

void SessionPage::showAct(const participant::ParticipantAct& act)
{
    const auto* agreement = std::get_if<participant::Agreement>(&act.what);
    if (agreement && !agreement->agrees) {
        m_hasDisagreed = true;
        m_isConsentAsked = false;
        return showMessage({}, Tone::Fault);
    }
    const bool isAnswer = std::holds_alternative<participant::FactsTold>(act.what);
    if (m_panel || !(agreement || isAnswer)) return;
    showMessage(
        isAnswer ? tr("The participant answered on their own screen.") : tr("The participant agreed on their own screen."),
        Tone::Done);
}

void SessionPage::holdKeys(MovedBy by)
{
    m_heldBy = by;
    m_sinceHeld.start();
}

bool SessionPage::isHeld() const
{
    constexpr int holdMs = 700;
    return !m_panel && m_sinceHeld.isValid() && m_sinceHeld.elapsed() < holdMs;
}

bool SessionPage::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::KeyRelease) m_heldKeys.isRepeat(static_cast<const QKeyEvent&>(*event));
    const bool isEntry = event->type() == QEvent::KeyPress || event->type() == QEvent::MouseButtonPress;
    const auto* target = qobject_cast<QWidget*>(watched);
    if (isEntry && isHeld() && target && (target == this || isAncestorOf(target))) {
        if (m_heldBy == MovedBy::Display)
            m_sinceHeld.start();  // the message names the fault
        else
            showMessage(tr("The participant has just moved the session on, so your entry did nothing. Enter it again."),
                        Tone::Hint);
        return true;
    }
    // A key that a control refuses goes on to its parents, so only the first receiver counts.
    const bool isFirst = event->type() == QEvent::KeyPress && watched == window()->focusWidget() && isVisible() &&
                         (watched == this || isAncestorOf(qobject_cast<QWidget*>(watched)));
    return (isFirst && takesKeyFirst(static_cast<const QKeyEvent&>(*event))) || QWidget::eventFilter(watched, event);
}

bool SessionPage::takesKeyFirst(const QKeyEvent& event)
{
    if (isScannedByMistake(event)) {
        pageInFront().discardEntry();
        showMessage(tr("A scanner typed this, so nothing was stored. Enter the answer by hand."), Tone::Hint);
        return true;
    }
    if (isOpeningKeyAgain(event)) return true;
    m_lastKey = {event.key(), event.timestamp()};
    const bool isPlain = (event.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == 0;
    if (!isPlain || !m_facts.keys.isExtraKey(event.key())) return false;
    if (!m_heldKeys.isRepeat(event)) pressKey(event.key());
    return true;
}

/// The key that opened a panel writes no letter into it while it is held down, or when it bounces.
bool SessionPage::isOpeningKeyAgain(const QKeyEvent& event)
{
    constexpr quint64 bounceMs = 120;
    const bool isSoon = event.timestamp() != 0 && event.timestamp() - m_openedBy.atMs < bounceMs;
    const bool isAgain = m_panel && event.key() == m_openedBy.key && (m_heldKeys.isRepeat(event) || isSoon);
    if (!isAgain) m_openedBy = {};
    return isAgain;
}

/// Only a text field outside questions and panels is there to be scanned into.
bool SessionPage::isScannedByMistake(const QKeyEvent& event)
{
    const bool isCharacter = !event.text().isEmpty() && event.text().front().isPrint();
    if (!m_scanner.endsWith(event.key(), isCharacter, event.timestamp())) return false;
    const bool isAsked = std::holds_alternative<Presenting>(m_view.state.stage) && !m_view.state.paused;
    return m_panel || isAsked || !qobject_cast<QLineEdit*>(window()->focusWidget());
}

}  // namespace study::app
