#include "study/app/session_page.h"

#include "study/app/checklist_page.h"
#include "study/app/correction_panel.h"
#include "study/app/debriefing_page.h"
#include "study/app/facts_page.h"
#include "study/app/familiarisation_page.h"
#include "study/app/guide_page.h"
#include "study/app/pieces.h"
#include "study/app/question_page.h"
#include "study/app/reason_panel.h"
#include "study/app/scale_training_page.h"
#include "study/app/session_footer.h"
#include "study/app/session_header.h"
#include "study/app/tray_page.h"

#include <QApplication>
#include <QKeyEvent>
#include <QScrollBar>
#include <QShortcut>
#include <QStackedWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace study::app {

using namespace session;

struct SessionPage::PageOfStage {
    const SessionPage& session;

    template <class GuidedStage>
    StagePage& operator()(const GuidedStage&) const
    {
        return *session.m_guide;
    }
    StagePage& operator()(const AskingFacts&) const { return *session.m_aboutParticipant; }
    StagePage& operator()(const Familiarising&) const { return *session.m_familiarisation; }
    StagePage& operator()(const ScaleTraining&) const { return *session.m_scaleTraining; }
    StagePage& operator()(const CheckingList&) const { return *session.m_checklist; }
    StagePage& operator()(const PlacingTray&) const { return *session.m_tray; }
    StagePage& operator()(const Presenting&) const { return *session.m_question; }
    StagePage& operator()(const Debriefing&) const { return *session.m_debriefing; }
};

namespace {

/// Where one types must be in sight, whatever the size of the text.
void letEntryBeSeen(QScrollArea& area)
{
    QWidget* focus = QApplication::focusWidget();
    if (focus && focus->testAttribute(Qt::WA_InputMethodEnabled) && area.isAncestorOf(focus))
        area.ensureWidgetVisible(focus, 0, 28);
}

}  // namespace

SessionPage::SessionPage(QWidget* parent)
    : QWidget(parent),
      m_header(new SessionHeader(this)),
      m_stages(new QStackedWidget(this)),
      m_message(new MessageBar("sessionMessage", this)),
      m_footer(new SessionFooter(this)),
      m_guide(new GuidePage(this)),
      m_aboutParticipant(new FactsPage(this)),
      m_familiarisation(new FamiliarisationPage(this)),
      m_scaleTraining(new ScaleTrainingPage(this)),
      m_checklist(new ChecklistPage(this)),
      m_tray(new TrayPage(this)),
      m_question(new QuestionPage(this)),
      m_debriefing(new DebriefingPage(this)),
      m_correction(new CorrectionPanel(this)),
      m_reason(new ReasonPanel(this))
{
    setObjectName("sessionPage");
    setFocusPolicy(Qt::ClickFocus);
    m_stages->setObjectName("stages");
    addPage(m_guide, "guideArea");
    addPage(m_aboutParticipant, "factsArea");
    addPage(m_familiarisation, "familiarisationArea");
    addPage(m_scaleTraining, "scaleTrainingArea");
    addPage(m_checklist, "checklistArea");
    addPage(m_tray, "trayArea");
    addPage(m_question, "questionArea");
    addPage(m_debriefing, "debriefingArea");
    addPage(m_correction, "correctionArea");
    addPage(m_reason, "reasonArea");
    auto* messageRow = new QVBoxLayout;
    messageRow->setContentsMargins(28, 0, 28, 10);
    messageRow->addWidget(m_message);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(m_header);
    column->addWidget(m_stages, 1);
    column->addLayout(messageRow);
    column->addWidget(m_footer);
    connect(m_guide, &GuidePage::leaveAsked, this, &SessionPage::leaveAsked);
    connect(m_guide, &GuidePage::preparationDeclined, this, &SessionPage::goOnUnprepared);
    joinPanels();
    bindKeysWhileWriting();
}

void SessionPage::addPage(StagePage* page, const char* areaName)
{
    m_all.push_back(page);
    QScrollArea* area = scrolling(areaName, page, m_stages);
    m_stages->addWidget(area);
    connect(area->verticalScrollBar(), &QScrollBar::rangeChanged, area, [area] { letEntryBeSeen(*area); });
    connect(page, &StagePage::eventAsked, this, &SessionPage::eventAsked);
    connect(page, &StagePage::hinted, this, [this](const QString& text) { tell(text, Tone::Hint); });
}

void SessionPage::joinPanels()
{
    connect(m_correction, &Panel::closeAsked, this, &SessionPage::closePanel);
    connect(m_reason, &Panel::closeAsked, this, &SessionPage::closePanel);
    const auto onAsking = [this](auto asked, auto ask) {
        connect(m_footer, asked, this, [this, ask] {
            ask();
            openPanel(*m_reason);
        });
    };
    onAsking(&SessionFooter::noteAsked, [this] { m_reason->askForNote(); });
    onAsking(&SessionFooter::flagAsked, [this] { m_reason->askForFlag(codeMeant()); });
    onAsking(&SessionFooter::voidAsked, [this] { m_reason->askWhyVoid(codeMeant()); });
    onAsking(&SessionFooter::withdrawAsked, [this] { m_reason->askWhyWithdrawn(); });
    connect(m_footer, &SessionFooter::correctionAsked, this, &SessionPage::correctionAsked);
    connect(m_footer, &SessionFooter::pauseAsked, this, [this] { Q_EMIT eventAsked(Paused{}); });
    connect(m_footer, &SessionFooter::leaveAsked, this, &SessionPage::leaveAsked);
}

void SessionPage::bindKeysWhileWriting()
{
    // In a field of text the letters are text; with Alt they are the keys that they are elsewhere.
    for (const int key : {Qt::Key_T, Qt::Key_L, Qt::Key_N, Qt::Key_F, Qt::Key_V, Qt::Key_P, Qt::Key_W, Qt::Key_Q, Qt::Key_G}) {
        auto* shortcut = new QShortcut(QKeySequence(Qt::ALT | key), this);
        shortcut->setContext(Qt::WidgetWithChildrenShortcut);
        shortcut->setAutoRepeat(false);
        connect(shortcut, &QShortcut::activated, this, [this, key] {
            if (!m_footer->pressKey(key))
                pageInFront().pressKey(key);
        });
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
    closePanel();
    m_facts = facts;
    m_view = {};
    m_isPreparationDeclined = false;
    m_message->clearMessage();
    m_header->begin(facts);
    for (StagePage* page : m_all)
        page->begin(facts);
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
    m_header->present(view);
    m_footer->present(view, canCorrect);
    m_guide->offerPreparation(offersPreparation());
    if (std::holds_alternative<Presenting>(view.state.stage))
        m_tray->setPlaced(view.trayIds);
    StagePage& page = pageOf(view);
    page.present(view);
    if (!m_panel)
        bringForward(page);
}

void SessionPage::goOnUnprepared()
{
    m_isPreparationDeclined = true;
    if (m_view.state.paused)
        Q_EMIT eventAsked(Resumed{});
    else
        present(View(m_view), m_footer->canCorrect());
}

StagePage& SessionPage::pageOf(const View& view) const
{
    if (view.state.paused || offersPreparation())
        return *m_guide;
    return std::visit(PageOfStage{*this}, view.state.stage);
}

StagePage& SessionPage::pageInFront() const
{
    return m_panel ? *m_panel : pageOf(m_view);
}

void SessionPage::bringForward(StagePage& page)
{
    for (int place = 0; place < m_stages->count(); ++place) {
        auto* area = static_cast<QScrollArea*>(m_stages->widget(place));
        if (!area->isAncestorOf(&page))
            continue;
        m_stages->setCurrentIndex(place);
        page.firstFocus().setFocus();
        area->verticalScrollBar()->setValue(0);  // a page is read from its top
        letEntryBeSeen(*area);
    }
    m_footer->setWriting(!m_panel && page.isForWriting());
}

void SessionPage::openCorrection(const std::vector<Correctable>& answers)
{
    m_correction->ask(answers);
    openPanel(*m_correction);
}

void SessionPage::openPanel(StagePage& panel)
{
    m_panel = &panel;
    m_message->clearMessage();
    m_footer->setPanelOpen(true);
    bringForward(panel);
}

void SessionPage::closePanel()
{
    if (!m_panel)
        return;
    m_panel = nullptr;
    m_message->clearMessage();
    m_footer->setPanelOpen(false);
    bringForward(pageOf(m_view));
}

void SessionPage::settle()
{
    m_message->clearMessage();
    m_panel = nullptr;
    m_footer->setPanelOpen(false);
}

void SessionPage::tell(const QString& text, Tone tone)
{
    switch (tone) {
    case Tone::Done: m_message->tellDone(text); break;
    case Tone::Hint:
    case Tone::Refusal: m_message->tellHint(text); break;
    case Tone::Fault: m_message->tellFault(text); break;
    }
}

bool SessionPage::pressKey(int key)
{
    if (isEnter(key) && pressFocusedButton())
        return true;
    return pageInFront().pressKey(key) || m_footer->pressKey(key) || scrollBy(key);
}

bool SessionPage::pressFocusedButton() const
{
    // Enter is the page's main action, but on a button that was tabbed to it presses that one.
    auto* focused = qobject_cast<QPushButton*>(focusWidget());
    const bool isSideButton = focused && focused->isVisible() && focused->isEnabled() && !focused->isCheckable() &&
                              focused->property("role").toString() != QLatin1String("main");
    if (isSideButton)
        focused->click();
    return isSideButton;
}

bool SessionPage::scrollBy(int key)
{
    if (key != Qt::Key_PageDown && key != Qt::Key_PageUp)
        return false;
    QScrollBar& bar = *static_cast<QScrollArea*>(m_stages->currentWidget())->verticalScrollBar();
    bar.setValue(bar.value() + (key == Qt::Key_PageDown ? bar.pageStep() : -bar.pageStep()));
    return true;
}

void SessionPage::keyPressEvent(QKeyEvent* event)
{
    const bool isPlain = (event->modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == 0;
    // A key held down must not run through several presentations.
    const bool isTaken = isPlain && (event->isAutoRepeat() || pressKey(event->key()));
    if (!isTaken)
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
