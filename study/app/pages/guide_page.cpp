#include "study/app/pages/guide_page.h"

#include <QVBoxLayout>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/step_list.h"

namespace study::app {

GuidePage::GuidePage(QWidget* parent)
    : StagePage(parent),
      m_head(new PageHead(this)),
      m_steps(new StepList(this)),
      m_action(mainButton("confirmButton", tr("Continue (Enter)"), this)),
      m_second(button("secondButton", tr("Skip the preparation (G)"), this))
{
    auto* column = new QVBoxLayout(this);
    column->setSpacing(14);
    column->addWidget(m_head);
    column->addWidget(m_steps);
    column->addSpacing(6);
    column->addLayout(actionsRow({m_action, m_second}));
    column->addStretch(1);
    connect(m_action, &QPushButton::clicked, this, [this] { act(m_guide.act); });
    connect(m_second, &QPushButton::clicked, this, [this] { act(m_guide.second->act); });
}

void GuidePage::present(const session::View& view)
{
    const auto guide = guideFor(view, m_facts, m_isPreparationDue);
    if (!guide) return;
    m_guide = *guide;
    m_head->setTexts(m_guide.title, m_guide.lead);
    m_steps->setSteps(m_guide.steps);
    setButtonText(*m_action, m_guide.action);
    m_second->setVisible(m_guide.second.has_value());
    if (m_guide.second) setButtonText(*m_second, m_guide.second->text);
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
