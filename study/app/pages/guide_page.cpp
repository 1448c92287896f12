#include "study/app/pages/guide_page.h"

#include <QApplication>
#include <QEvent>
#include <QScrollArea>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/step_list.h"

namespace study::app {

namespace {

constexpr int smallestZoom = 60, largestZoom = 200, zoomStep = 10;  ///< percent of the usual type

/// Size that the page may have without scrolling, px.
QSize roomFor(const QWidget& page)
{
    const QWidget* parent = page.parentWidget();
    const QLayout* around = parent ? parent->layout() : nullptr;
    while (parent && !qobject_cast<const QScrollArea*>(parent)) parent = parent->parentWidget();
    if (!parent || !around) return page.size();
    const QMargins margins = around->contentsMargins();
    return static_cast<const QScrollArea*>(parent)->viewport()->size().shrunkBy(margins);
}

}  // namespace

GuidePage::GuidePage(QWidget* parent)
    : StagePage(parent),
      m_tick(new QTimer(this)),
      m_clock(label("breakClock", Type::Title, this, Weight::Bold)),
      m_head(new PageHead(this)),
      m_steps(new StepList(this, Type::Words)),
      m_action(mainButton("confirmButton", tr("Continue (Enter)"), this)),
      m_second(button("secondButton", tr("Skip the preparation (G)"), this))
{
    auto* column = new QVBoxLayout(this);
    column->setSpacing(22);
    column->addWidget(m_head);
    column->addWidget(m_clock);
    column->addWidget(m_steps);
    column->addLayout(m_messagePlace);
    column->addSpacing(6);
    column->addLayout(actionsRow({m_action, m_second}));
    column->addStretch(1);
    m_tick->setInterval(1000);
    connect(m_tick, &QTimer::timeout, this, &GuidePage::showClock);
    connect(m_action, &QPushButton::clicked, this, [this] { act(m_guide.act); });
    connect(m_second, &QPushButton::clicked, this, [this] { act(m_guide.second->act); });
}

void GuidePage::present(const session::View& view)
{
    const auto guide = guideFor(view, m_facts, m_isPreparationDue);
    if (!guide) return;
    m_guide = *guide;
    const auto* onBreak = view.state.paused ? nullptr : std::get_if<session::OnBreak>(&view.state.stage);
    m_breakBefore = std::chrono::milliseconds(std::llround(view.breakSeconds * 1000));
    m_sinceShown.start();
    m_clock->setVisible(onBreak != nullptr);
    if (onBreak) {
        showClock();
        m_tick->start();
    } else {
        m_tick->stop();
    }
    m_head->setTexts(m_guide.title, m_guide.lead);
    m_steps->setSteps(m_guide.steps);
    setButtonText(*m_action, m_guide.action);
    m_second->setVisible(m_guide.second.has_value());
    if (m_guide.second) setButtonText(*m_second, m_guide.second->text);
    if (isVisible()) fit();
    fitLater();  // a page that has not been shown yet has no true width
}

void GuidePage::resizeEvent(QResizeEvent* event)
{
    StagePage::resizeEvent(event);
    fitLater();
}

void GuidePage::changeEvent(QEvent* event)
{
    StagePage::changeEvent(event);
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) fitLater();
}

/// Queued, because a layout must not change while it is computed.
void GuidePage::fitLater()
{
    if (m_isFitDue) return;
    m_isFitDue = true;
    QMetaObject::invokeMethod(
        this,
        [this] {
            m_isFitDue = false;
            fit();
        },
        Qt::QueuedConnection);
}

/// Takes the largest type with which the page needs no scrolling.
void GuidePage::fit()
{
    const QSize room = roomFor(*this);
    const int textWidth = std::min(room.width(), maximumWidth());
    int fits = smallestZoom, tooLarge = largestZoom + zoomStep;
    while (tooLarge - fits > zoomStep) {
        const int middle = (fits + tooLarge) / (2 * zoomStep) * zoomStep;
        zoom(middle);
        const bool isLow = layout()->totalHeightForWidth(textWidth) <= room.height();
        (isLow && layout()->totalMinimumSize().width() <= room.width() ? fits : tooLarge) = middle;
    }
    zoom(fits);
}

void GuidePage::zoom(int percent)
{
    const double points = QApplication::font().pointSizeF() * percent / 100;
    const auto enlarge = [&](QWidget& of, Type type) {
        of.setStyleSheet(QStringLiteral("font-size: %1pt;").arg(points * factorOf(type), 0, 'f', 1));
        of.ensurePolished();
    };
    enlarge(*m_clock, Type::Title);
    enlarge(*m_action, Type::Lead);
    for (auto* text : m_head->findChildren<QLabel*>())
        enlarge(*text, text->objectName() == QLatin1String("pageTitle") ? Type::Title : Type::Lead);
    for (auto* step : m_steps->findChildren<QLabel*>()) enlarge(*step, Type::Words);
    // The layout of the page keeps the heights of its parts until they announce others, which they do only when they are shown.
    for (QWidget* part : {static_cast<QWidget*>(m_head), static_cast<QWidget*>(m_steps)}) {
        part->layout()->invalidate();
        part->updateGeometry();
    }
    layout()->invalidate();
}

void GuidePage::showClock()
{
    const qint64 seconds = (m_breakBefore.count() + m_sinceShown.elapsed()) / 1000;
    m_clock->setText(tr("Break: %1:%2").arg(seconds / 60).arg(seconds % 60, 2, 10, QLatin1Char('0')));
}

void GuidePage::act(GuideAct act)
{
    switch (act) {
        case GuideAct::Send:
            Q_EMIT eventRequested(session::EventBody(m_guide.event));
            break;
        case GuideAct::Leave:
            Q_EMIT leaveRequested();
            break;
        case GuideAct::DeclinePreparation:
            Q_EMIT preparationDeclined();
            break;
    }
}

bool GuidePage::pressKey(int key)
{
    if (isEnter(key))
        act(m_guide.act);
    else if (m_guide.second && key == m_guide.second->key)
        act(m_guide.second->act);
    else
        return false;
    return true;
}

QWidget& GuidePage::firstFocus() { return *m_action; }

}  // namespace study::app
