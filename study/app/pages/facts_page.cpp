#include "study/app/pages/facts_page.h"

#include <QVBoxLayout>

#include "study/app/pieces/line_form.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

FactsPage::FactsPage(QWidget* parent)
    : StagePage(parent),
      m_rights(quietLabel("rightsText", this)),
      m_form(new LineForm("fact", this)),
      m_action(mainButton("confirmButton", tr("Continue (Enter)"), this))
{
    auto* head = new PageHead(this);
    head->setTexts(tr("About the participant"),
                   tr("Ask the participant and write the answers down. You may leave any line empty."));
    auto* column = new QVBoxLayout(this);
    column->setSpacing(14);
    column->addWidget(head);
    column->addWidget(m_rights);
    column->addWidget(m_form);
    column->addLayout(m_messagePlace);
    column->addStretch(1);
    connect(m_action, &QPushButton::clicked, this, &FactsPage::confirm);
}

void FactsPage::begin(const SessionFacts& facts)
{
    m_rights->setText(tr("Say: “%1”").arg(facts.sentence("say_facts")));
    m_form->setCaptions(facts.facts);
    setTabOrderAfter(*m_form, {m_action});
    Q_EMIT textChanged();
}

void FactsPage::confirm() { Q_EMIT eventRequested(session::FactsGiven{m_form->given()}); }

bool FactsPage::hasUnstoredText() const { return !m_form->given().empty(); }

bool FactsPage::pressKey(int key)
{
    if (!isEnter(key)) return false;
    if (!m_form->focusNext()) confirm();
    return true;
}

QWidget& FactsPage::firstFocus()
{
    QWidget* open = m_form->firstOpen();
    return open ? *open : *m_action;
}

QWidget* FactsPage::pinned() { return m_action; }

}  // namespace study::app
