#include "study/app/guide_page.h"

#include "study/app/pieces.h"
#include "study/app/scale_line.h"
#include "study/app/stage_guides.h"
#include "study/app/tick_box.h"

#include <QHBoxLayout>
#include <QKeyEvent>
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
      m_title(label("guideTitle", Type::Title, this, Weight::Bold)),
      m_lead(label("guideLead", Type::Lead, this)),
      m_scalePart(new QWidget(this)),
      m_line(new ScaleLine(ScaleLine::Use::Show, m_scalePart)),
      m_lowAnchor(label("lowAnchor", Type::Body, m_scalePart)),
      m_highAnchor(label("highAnchor", Type::Body, m_scalePart)),
      m_steps(new QVBoxLayout),
      m_checks(new QVBoxLayout),
      m_action(mainButton("confirmButton", tr("Go on (Enter)"), this))
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

    m_steps->setSpacing(8);
    m_checks->setSpacing(4);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(14);
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
    m_guide = {};
    for (const QString& item : items)
        m_checks->addWidget(checkRow(item));
}

QWidget* GuidePage::checkRow(const QString& item)
{
    auto* row = new QWidget(this);
    auto* box = new TickBox(row);
    name(*box, qPrintable(QStringLiteral("check%1").arg(m_boxes.size() + 1)), item);
    auto* text = label("checkText", Type::Body, row);
    text->setText(item);
    text->setBuddy(box);
    for (QWidget* part : {static_cast<QWidget*>(box), static_cast<QWidget*>(text)})
        part->installEventFilter(this);
    // Ticking goes down the list by itself, so that a row of spaces ticks all.
    connect(box, &QCheckBox::toggled, this, [this] { firstFocus().setFocus(); });
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(box, 0, Qt::AlignTop);
    layout->addWidget(text, 1);
    m_boxes.push_back(box);
    return row;
}

void GuidePage::setScale(const protocols::Scale& scale)
{
    m_line->setScale(scale);
}

void GuidePage::present(const session::View& view)
{
    if (const auto guide = guideFor(view))
        tell(*guide);
}

void GuidePage::tell(const Guide& guide)
{
    const bool isAnother = m_guide.title != guide.title;
    m_guide = guide;
    m_title->setText(guide.title);
    showText(*m_lead, guide.lead);
    m_scalePart->setVisible(guide.showsScale);
    showSteps(guide.steps);
    if (isAnother)
        showChecklist();
    setButtonText(*m_action, guide.action);
}

void GuidePage::showChecklist()
{
    // A box ticked here stays in sight; one ticked on an earlier page is not asked again.
    for (QCheckBox* box : m_boxes)
        box->parentWidget()->setVisible(m_guide.checklist == Checklist::Offered ||
                                        (m_guide.checklist == Checklist::Required && !box->isChecked()));
}

void GuidePage::showSteps(const QStringList& steps)
{
    emptyOut(*m_steps);
    for (qsizetype i = 0; i < steps.size(); ++i) {
        auto* step = label(qPrintable(QStringLiteral("step%1").arg(i + 1)), Type::Body, this);
        step->setText(steps.size() == 1 ? steps[i] : QStringLiteral("%1.  %2").arg(i + 1).arg(steps[i]));
        m_steps->addWidget(step);
        step->show();
    }
}

QCheckBox* GuidePage::firstUnticked() const
{
    if (m_guide.checklist == Checklist::None)
        return nullptr;
    const auto found = std::find_if(m_boxes.begin(), m_boxes.end(), [](const QCheckBox* box) { return !box->isChecked(); });
    return found == m_boxes.end() ? nullptr : *found;
}

void GuidePage::confirm()
{
    QCheckBox* open = m_guide.checklist == Checklist::Required ? firstUnticked() : nullptr;
    if (open) {
        open->setFocus();
        Q_EMIT hinted(tr("Not ticked yet: %1. Space ticks it.").arg(open->accessibleName()));
    } else if (m_guide.event) {
        Q_EMIT eventAsked(*m_guide.event);
    } else {
        Q_EMIT leaveAsked();
    }
}

bool GuidePage::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::KeyPress && pressKey(static_cast<QKeyEvent*>(event)->key()))
        return true;
    if (const auto* text = qobject_cast<QLabel*>(watched); text && event->type() == QEvent::MouseButtonRelease)
        static_cast<QCheckBox*>(text->buddy())->toggle();
    return StagePage::eventFilter(watched, event);
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
