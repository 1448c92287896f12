#include "study/app/pages/familiarisation_page.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/step_list.h"

namespace study::app {

using session::FamiliarisationShown;

FamiliarisationPage::FamiliarisationPage(QWidget* parent)
    : StagePage(parent),
      m_steps(new StepList(this)),
      m_fabricsRow(new QWidget(this)),
      m_shown(label("shownFabric", Type::Lead, this)),
      m_action(mainButton("confirmButton", tr("The participant is ready (Enter)"), this))
{
    auto* head = new PageHead(this);
    head->setTexts(tr("Getting to know the display"),
                   tr("Nothing is scored here. Seat the participant so that one hand reaches both the display and the tray."));
    m_fabricsRow->setLayout(new FlowLayout(10, 8));
    auto* column = new QVBoxLayout(this);
    column->setSpacing(14);
    column->addWidget(head);
    column->addWidget(m_steps);
    column->addWidget(m_fabricsRow);
    column->addLayout(m_messagePlace);
    auto* actions = new QHBoxLayout;
    actions->setSpacing(20);
    actions->addWidget(m_action);
    actions->addWidget(m_shown, 1);
    actions->addStretch();  // where nothing is shown, the button keeps its width
    column->addLayout(actions);
    column->addStretch(1);
    connect(m_action, &QPushButton::clicked, this, [this] { Q_EMIT eventRequested(session::FamiliarisationDone{}); });
}

void FamiliarisationPage::begin(const SessionFacts& facts)
{
    m_strokeWords = facts.strokeWords;
    m_saySoon = facts.sentence("say_soon");
    showSteps();
}

void FamiliarisationPage::showSteps()
{
    QStringList steps;
    if (!m_strokeWords.isEmpty()) steps << tr("Say: “%1”").arg(m_strokeWords);
    if (m_fabrics.empty())
        steps << tr("Let the participant stroke some fabrics on the table, then the glass of the display.");
    else
        steps << tr(
            "Put one of these fabrics on the table and press its number: the display shows it. Let the participant stroke both "
            "as long as they like. Then take the next fabric.");
    steps << tr("Say: “%1”").arg(m_saySoon);
    m_steps->setSteps(steps);
    Q_EMIT textChanged();
}

void FamiliarisationPage::setFabrics(const std::vector<std::string>& fabrics)
{
    m_fabrics = fabrics;
    qDeleteAll(m_buttons);
    m_buttons.clear();
    for (std::size_t item = 0; item < fabrics.size(); ++item) {
        auto* made = button(qPrintable(QStringLiteral("familiar%1").arg(item + 1)),
                            QStringLiteral("%1    %2").arg(item + 1).arg(QString::fromStdString(fabrics[item])), m_fabricsRow);
        made->setCheckable(true);
        connect(made, &QPushButton::clicked, this,
                [this, item] { Q_EMIT eventRequested(FamiliarisationShown{static_cast<int>(item)}); });
        m_fabricsRow->layout()->addWidget(made);
        made->show();
        m_buttons.push_back(made);
    }
    m_fabricsRow->setVisible(!fabrics.empty());
    showSteps();
}

void FamiliarisationPage::present(const session::View& view)
{
    if (view.familiarisation != m_fabrics) setFabrics(view.familiarisation);
    const auto shown = std::get<session::Familiarising>(view.state.stage).shown;
    for (std::size_t item = 0; item < m_buttons.size(); ++item) m_buttons[item]->setChecked(shown == static_cast<int>(item));
    if (m_fabrics.empty())
        showText(*m_shown, {});
    else if (shown)
        showText(*m_shown,
                 tr("The display now shows %1.").arg(QString::fromStdString(m_fabrics.at(static_cast<std::size_t>(*shown)))));
    else
        showText(*m_shown, tr("The display shows nothing now."));
}

bool FamiliarisationPage::pressKey(int key)
{
    const int item = key - Qt::Key_1;
    if (isEnter(key))
        Q_EMIT eventRequested(session::FamiliarisationDone{});
    else if (item >= 0 && item < 9 && item < static_cast<int>(m_fabrics.size()))
        Q_EMIT eventRequested(FamiliarisationShown{item});
    else
        return false;
    return true;
}

QWidget& FamiliarisationPage::firstFocus() { return *m_action; }

}  // namespace study::app
