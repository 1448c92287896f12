#include "study/app/pages/stage_stack.h"

#include <QApplication>
#include <QLineEdit>
#include <QScrollBar>
#include <QTimer>
#include <algorithm>

#include "study/app/pages/checklist_page.h"
#include "study/app/pages/correction_panel.h"
#include "study/app/pages/debriefing_page.h"
#include "study/app/pages/facts_page.h"
#include "study/app/pages/familiarisation_page.h"
#include "study/app/pages/guide_page.h"
#include "study/app/pages/question_page.h"
#include "study/app/pages/reason_panel.h"
#include "study/app/pages/scale_training_page.h"
#include "study/app/pages/tray_page.h"
#include "study/app/pieces/page_fit.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

using namespace session;

struct StageStack::PageOfStage {
    const StageStack& stack;

    template <class GuidedStage>
    StagePage& operator()(const GuidedStage&) const
    {
        return *stack.m_guide;
    }
    StagePage& operator()(const AskingFacts&) const { return *stack.m_facts; }
    StagePage& operator()(const Familiarising&) const { return *stack.m_familiarisation; }
    StagePage& operator()(const ScaleTraining&) const { return *stack.m_scaleTraining; }
    StagePage& operator()(const CheckingList&) const { return *stack.m_checklist; }
    StagePage& operator()(const PlacingTray&) const { return *stack.m_tray; }
    StagePage& operator()(const Presenting&) const { return *stack.m_question; }
    StagePage& operator()(const Debriefing&) const { return *stack.m_debriefing; }
};

namespace {

/// Keeps the answer, and the text field that has the focus, in view at every text size.
void scrollToEntry(QScrollArea& area, StagePage& page)
{
    constexpr int marginPx = 28;
    QWidget* focus = QApplication::focusWidget();
    if (!focus || !area.isAncestorOf(focus)) return;
    if (page.lastOfAnswer()) area.verticalScrollBar()->setValue(0);
    if (QWidget* last = page.lastOfAnswer()) area.ensureWidgetVisible(last, 0, 4);
    if (page.lastOfAnswer() || qobject_cast<QLineEdit*>(focus) || focus->testAttribute(Qt::WA_InputMethodEnabled))
        area.ensureWidgetVisible(focus, 0, page.lastOfAnswer() ? 4 : marginPx);
}

/// The area with the control below it, both in one widget.
QWidget* above(QScrollArea& area, QWidget& pinned)
{
    constexpr int sidePx = 28, topPx = 8, bottomPx = 14;
    auto* both = new QWidget(area.parentWidget());
    auto* column = new QVBoxLayout(both);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(&area, 1);
    auto* row = new QHBoxLayout;
    row->setContentsMargins(sidePx, topPx, sidePx, bottomPx);
    row->addWidget(&pinned, 0, Qt::AlignLeft);
    column->addLayout(row);
    return both;
}

}  // namespace

StageStack::StageStack(QWidget* parent)
    : QStackedWidget(parent),
      m_guide(add<GuidePage>("guideArea")),
      m_facts(add<FactsPage>("factsArea")),
      m_familiarisation(add<FamiliarisationPage>("familiarisationArea")),
      m_scaleTraining(add<ScaleTrainingPage>("scaleTrainingArea")),
      m_checklist(add<ChecklistPage>("checklistArea")),
      m_tray(add<TrayPage>("trayArea")),
      m_question(add<QuestionPage>("questionArea")),
      m_debriefing(add<DebriefingPage>("debriefingArea")),
      m_correction(add<CorrectionPanel>("correctionArea")),
      m_reason(add<ReasonPanel>("reasonArea"))
{
    setObjectName("stages");
    connect(m_correction, &FormPanel::closeRequested, this, &StageStack::panelCloseRequested);
    connect(m_reason, &FormPanel::closeRequested, this, &StageStack::panelCloseRequested);
}

template <class Page>
Page* StageStack::add(const char* areaName)
{
    auto* page = new Page(this);
    m_pages.push_back(page);
    QScrollArea* area = scrolling(areaName, page, this);
    m_areas.push_back(area);
    addWidget(page->pinned() ? above(*area, *page->pinned()) : area);
    PageFit::of(*area)->setLargest(page->largestType());
    connect(page, &StagePage::textChanged, PageFit::of(*area), &PageFit::refit);
    connect(page, &StagePage::eventRequested, this, &StageStack::eventRequested);
    connect(page, &StagePage::answerMarked, this, &StageStack::answerMarked);
    connect(page, &StagePage::hinted, this, &StageStack::hinted);
    connect(page, &StagePage::mended, this, &StageStack::mended);
    connect(page, &StagePage::patternRequested, this, &StageStack::patternRequested);
    connect(area->verticalScrollBar(), &QScrollBar::rangeChanged, area, [area, page] { scrollToEntry(*area, *page); });
    connect(area->verticalScrollBar(), &QScrollBar::rangeChanged, this, &StageStack::checkMessageSoon);
    connect(area->verticalScrollBar(), &QScrollBar::valueChanged, this, &StageStack::checkMessageSoon);
    return page;
}

void StageStack::begin(const SessionFacts& facts)
{
    for (StagePage* page : m_pages) page->begin(facts);
}

StagePage& StageStack::pageOf(const Stage& stage) const { return std::visit(PageOfStage{*this}, stage); }

void StageStack::bringForward(StagePage& page)
{
    const auto place = std::find(m_pages.begin(), m_pages.end(), &page) - m_pages.begin();
    QScrollArea& area = areaAt(static_cast<int>(place));
    setCurrentIndex(static_cast<int>(place));
    page.firstFocus().setFocus();
    area.verticalScrollBar()->setValue(0);
    scrollToEntry(area, page);
    checkMessageSoon();
}

void StageStack::showMessage(QWidget& message)
{
    m_message = &message;
    // Queued, because the page gets its new height first. The entry comes last: it is more important than the message.
    QMetaObject::invokeMethod(
        &message,
        [this, &message] {
            QScrollArea& area = areaAt(currentIndex());
            if (message.isVisible() && area.isAncestorOf(&message)) area.ensureWidgetVisible(&message, 0, 8);
            scrollToEntry(area, *m_pages[static_cast<std::size_t>(currentIndex())]);
            checkMessageSoon();
        },
        Qt::QueuedConnection);
}

/// By a timer, which waits for all layouts and for the fit of the page.
void StageStack::checkMessageSoon() { QTimer::singleShot(0, this, &StageStack::checkMessage); }

void StageStack::checkMessage()
{
    const QScrollArea& area = areaAt(currentIndex());
    if (!m_message || !m_message->isVisible() || !area.isAncestorOf(m_message)) return;
    const int top = m_message->mapTo(area.viewport(), QPoint()).y();
    if (top < 0 || top + m_message->height() > area.viewport()->height()) Q_EMIT messageHidden();
}

bool StageStack::scrollBy(int key)
{
    if (key != Qt::Key_PageDown && key != Qt::Key_PageUp) return false;
    QScrollBar& bar = *areaAt(currentIndex()).verticalScrollBar();
    bar.setValue(bar.value() + (key == Qt::Key_PageDown ? bar.pageStep() : -bar.pageStep()));
    return true;
}

}  // namespace study::app
