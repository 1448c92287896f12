#include "study/app/guide_page.h"

#include "study/app/pieces.h"
#include "study/app/scale_line.h"
#include "study/app/stage_guides.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace study::app {

namespace {

void emptyOut(QLayout& layout)
{
    while (QLayoutItem* item = layout.takeAt(0)) {
        delete item->widget();
        delete item;
    }
}

}  // namespace

GuidePage::GuidePage(QWidget* parent)
    : StagePage(parent),
      m_title(label("guideTitle", size::title, this, Weight::Bold)),
      m_lead(label("guideLead", size::lead, this)),
      m_scalePart(new QWidget(this)),
      m_line(new ScaleLine(ScaleLine::Use::Show, m_scalePart)),
      m_lowAnchor(label("lowAnchor", size::body, m_scalePart)),
      m_highAnchor(label("highAnchor", size::body, m_scalePart)),
      m_steps(new QVBoxLayout),
      m_checks(new QVBoxLayout),
      m_action(mainButton("confirmButton", QString(), this))
{
    m_line->setObjectName("memorisedLine");
    m_scalePart->setObjectName("scalePart");
    m_lowAnchor->setText(tr("unrelated: sandpaper and silk"));
    m_highAnchor->setText(tr("totally the same: two pieces of the same fabric"));
    m_highAnchor->setAlignment(Qt::AlignRight);
    auto* anchors = new QHBoxLayout;
    anchors->addWidget(m_lowAnchor, 1);
    anchors->addSpacing(40);
    anchors->addWidget(m_highAnchor, 1);
    auto* scalePart = new QVBoxLayout(m_scalePart);
    scalePart->setContentsMargins(0, 8, 0, 8);
    scalePart->addWidget(m_line);
    scalePart->addLayout(anchors);

    m_steps->setSpacing(12);
    m_checks->setSpacing(6);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(18);
    column->addWidget(m_title);
    column->addWidget(m_lead);
    column->addWidget(m_scalePart);
    column->addLayout(m_steps);
    column->addLayout(m_checks);
    column->addSpacing(6);
    column->addWidget(m_action, 0, Qt::AlignLeft);
    column->addStretch(1);
    connect(m_action, &QPushButton::clicked, this, &GuidePage::confirm);
}

void GuidePage::setChecklist(const QStringList& items)
{
    emptyOut(*m_checks);
    m_boxes.clear();
    for (const QString& item : items) {
        auto* box = new QCheckBox(QString(item).replace(QLatin1Char('&'), QLatin1String("&&")), this);
        name(*box, qPrintable(QStringLiteral("check%1").arg(m_boxes.size() + 1)), item);
        setTypeSize(*box, size::body);
        // Ticking goes down the list by itself, so that a row of spaces ticks all.
        connect(box, &QCheckBox::toggled, this, [this] { firstFocus().setFocus(); });
        m_checks->addWidget(box);
        m_boxes.push_back(box);
    }
}

void GuidePage::setScale(const protocols::Scale& scale)
{
    m_line->setScale(scale);
}

void GuidePage::present(const session::View& view)
{
    if (const auto guide = guideFor(view))
        show(*guide);
}

void GuidePage::show(const Guide& guide)
{
    m_guide = guide;
    m_title->setText(guide.title);
    showText(*m_lead, guide.showsChecklist && m_boxes.empty() ? tr("The participant does not wear the mask yet.") : guide.lead);
    m_scalePart->setVisible(guide.showsScale);
    showSteps(guide.steps);
    for (QCheckBox* box : m_boxes)
        box->setVisible(guide.showsChecklist);
    setButtonText(*m_action, guide.action);
}

void GuidePage::showSteps(const QStringList& steps)
{
    emptyOut(*m_steps);
    for (qsizetype i = 0; i < steps.size(); ++i) {
        auto* step = label(qPrintable(QStringLiteral("step%1").arg(i + 1)), size::body, this);
        step->setText(steps.size() == 1 ? steps[i] : QStringLiteral("%1.  %2").arg(i + 1).arg(steps[i]));
        m_steps->addWidget(step);
    }
}

QCheckBox* GuidePage::firstUnticked() const
{
    if (!m_guide.showsChecklist)
        return nullptr;
    const auto found = std::find_if(m_boxes.begin(), m_boxes.end(), [](const QCheckBox* box) { return !box->isChecked(); });
    return found == m_boxes.end() ? nullptr : *found;
}

void GuidePage::confirm()
{
    if (QCheckBox* open = firstUnticked()) {
        open->setFocus();
        Q_EMIT hinted(tr("Not ticked yet: %1. Space ticks it.").arg(open->accessibleName()));
    } else if (m_guide.event) {
        Q_EMIT eventAsked(*m_guide.event);
    } else {
        Q_EMIT leaveAsked();
    }
}

bool GuidePage::pressKey(int key)
{
    if (!isEnter(key))
        return false;
    confirm();
    return true;
}

QWidget& GuidePage::firstFocus()
{
    if (QCheckBox* open = firstUnticked())
        return *open;
    return *m_action;
}

}  // namespace study::app
