#include "study/app/pages/debriefing_page.h"

#include <QVBoxLayout>

#include "study/app/pieces/pieces.h"
#include "study/app/pieces/step_list.h"
#include "study/app/pieces/words_field.h"

namespace study::app {

DebriefingPage::DebriefingPage(QWidget* parent)
    : StagePage(parent),
      m_steps(new StepList(this)),
      m_notes(new WordsField("debriefingField", tr("Comments of the participant about the session"), this))
{
    auto* head = new PageHead(this);
    head->setTexts(tr("After the last presentation"), tr("The display is off. The participant may take off the mask now."));
    auto* rights = quietLabel("rightsText", this);
    rights->setText(
        tr("You may leave the field empty. The text is stored apart from the answers and can be erased later. "
           "Press Shift and Enter for a new line."));
    auto* action = mainButton("confirmButton", tr("Finish the session (Enter)"), this);
    m_notes->setLines(2, 3, 8);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(14);
    for (QWidget* part : {static_cast<QWidget*>(head), static_cast<QWidget*>(m_steps), static_cast<QWidget*>(m_notes),
                          static_cast<QWidget*>(rights)})
        column->addWidget(part, part == m_notes ? 1 : 0);
    column->addLayout(m_messagePlace);
    column->addSpacing(6);
    column->addWidget(action, 0, Qt::AlignLeft);
    column->addStretch(0);
    setTabOrder(m_notes, action);
    connect(action, &QPushButton::clicked, this, &DebriefingPage::confirm);
}

void DebriefingPage::begin(const SessionFacts& facts)
{
    m_steps->setSteps({tr("Ask: “%1”").arg(facts.sentence("ask_strategy")),
                       tr("Ask: “%1” Then explain the purpose of the study.").arg(facts.sentence("ask_purpose"))});
    m_notes->clear();
}

void DebriefingPage::confirm() { Q_EMIT eventRequested(session::Debriefed{m_notes->words().toStdString()}); }

bool DebriefingPage::pressKey(int key)
{
    if (!isEnter(key)) return false;
    confirm();
    return true;
}

bool DebriefingPage::hasUnstoredText() const { return !m_notes->words().isEmpty(); }

QWidget& DebriefingPage::firstFocus() { return *m_notes; }

}  // namespace study::app
