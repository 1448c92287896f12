#include "study/app/session_page.h"

#include "study/app/choice_page.h"
#include "study/app/correction_panel.h"
#include "study/app/guide_page.h"
#include "study/app/pieces.h"
#include "study/app/rating_page.h"
#include "study/app/reason_panel.h"
#include "study/app/session_footer.h"
#include "study/app/session_header.h"
#include "study/app/stage_guides.h"
#include "study/app/tray_page.h"

#include <QKeyEvent>
#include <QScrollBar>
#include <QStackedWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace study::app {

SessionPage::SessionPage(QWidget* parent)
    : QWidget(parent),
      m_header(new SessionHeader(this)),
      m_stages(new QStackedWidget(this)),
      m_message(new MessageBar("sessionMessage", this)),
      m_footer(new SessionFooter(this)),
      m_guide(new GuidePage(this)),
      m_tray(new TrayPage(this)),
      m_choice(new ChoicePage(this)),
      m_rating(new RatingPage(this)),
      m_correction(new CorrectionPanel(this)),
      m_reason(new ReasonPanel(this))
{
    setObjectName("sessionPage");
    setFocusPolicy(Qt::ClickFocus);
    m_stages->setObjectName("stages");
    addPage(m_guide, "guideArea");
    addPage(m_tray, "trayArea");
    addPage(m_choice, "choiceArea");
    addPage(m_rating, "ratingArea");
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
    joinPanels();
}

void SessionPage::addPage(StagePage* page, const char* areaName)
{
    m_stages->addWidget(scrolling(areaName, page, m_stages));
    connect(page, &StagePage::eventAsked, this, &SessionPage::eventAsked);
    connect(page, &StagePage::hinted, this, [this](const QString& text) { tell(text, Tone::Hint); });
}

void SessionPage::joinPanels()
{
    connect(m_correction, &CorrectionPanel::closeAsked, this, &SessionPage::closePanel);
    connect(m_reason, &ReasonPanel::closeAsked, this, &SessionPage::closePanel);
    connect(m_footer, &SessionFooter::correctionAsked, this, [this] {
        m_correction->ask(m_correctables);
        openPanel(*m_correction);
    });
    const auto askFor = [this](const Reason& reason) {
        m_reason->ask(reason);
        openPanel(*m_reason);
    };
    connect(m_footer, &SessionFooter::noteAsked, this, [askFor] { askFor(noteReason()); });
    connect(m_footer, &SessionFooter::voidAsked, this,
            [this, askFor] { askFor(voidReason(codeThatAVoidIsAbout())); });
    connect(m_footer, &SessionFooter::withdrawAsked, this, [askFor] { askFor(withdrawReason()); });
    connect(m_footer, &SessionFooter::pauseAsked, this, [this] { Q_EMIT eventAsked(session::Paused{}); });
    connect(m_footer, &SessionFooter::leaveAsked, this, &SessionPage::leaveAsked);
}

QString SessionPage::codeThatAVoidIsAbout() const
{
    const auto* tray = std::get_if<session::PlacingTray>(&m_view.state.stage);
    const auto& answers = m_view.state.answers;
    const bool isUnbegun = tray && std::none_of(answers.begin(), answers.end(),
                                                [&](const auto& answer) { return answer.index == tray->index; });
    return isUnbegun ? QString() : QString::fromStdString(m_view.code.value);
}

void SessionPage::begin(const SessionFacts& facts)
{
    closePanel();
    m_view = {};
    m_tray->setPlaced({});
    m_guide->setChecklist(facts.checklist);
    m_guide->setScale(facts.scale);
}

void SessionPage::present(const session::View& view, const std::vector<Correctable>& correctables)
{
    m_view = view;
    m_correctables = correctables;
    m_header->present(view);
    m_footer->present(view, !correctables.empty());
    rememberTray(view);
    StagePage& page = pageOf(view);
    page.present(view);
    if (!m_panel)
        bringForward(page);
}

void SessionPage::rememberTray(const session::View& view)
{
    if (std::holds_alternative<session::Presenting>(view.state.stage))
        m_tray->setPlaced(view.trayIds);
}

StagePage& SessionPage::pageOf(const session::View& view) const
{
    if (guideFor(view))
        return *m_guide;
    if (std::holds_alternative<session::PlacingTray>(view.state.stage))
        return *m_tray;
    if (view.scale)
        return *m_rating;
    return *m_choice;
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
        area->verticalScrollBar()->setValue(0);  // a page is read from its top, wherever the focus is
    }
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
    if (tone == Tone::Fault)
        m_message->tellFault(text);
    else
        m_message->tellHint(text);
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
