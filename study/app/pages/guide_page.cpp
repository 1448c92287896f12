#include "study/app/pages/guide_page.h"

#include <QTimer>
#include <QVBoxLayout>
#include <cmath>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/step_list.h"

namespace study::app {

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
    Q_EMIT textChanged();
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
