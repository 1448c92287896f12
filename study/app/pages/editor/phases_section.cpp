#include "study/app/pages/editor/phases_section.h"

#include <QComboBox>
#include <QListWidget>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "study/app/drafts/draft_edits.h"
#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pages/editor/phase_detail.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

PhasesSection::PhasesSection(DraftFields& fields, QWidget* parent)
    : QWidget(parent),
      m_fields(fields),
      m_list(new QListWidget(this)),
      m_newKind(choiceBox("newPhaseKind", tr("Kind of a new phase"), this)),
      m_add(button("addPhaseButton", tr("Add a phase"), this)),
      m_up(button("phaseUpButton", tr("Move up"), this)),
      m_down(button("phaseDownButton", tr("Move down"), this)),
      m_remove(button("removePhaseButton", tr("Remove"), this)),
      m_place(new QVBoxLayout)
{
    auto* column = new QVBoxLayout(this);
    column->setSpacing(10);
    addHead(*column, "phasesTitle", tr("Questions"),
            tr("In a phase, every fabric is felt under every condition once. Its questions follow one another. Phases follow in "
               "this order."));
    name(*m_list, "phaseList", tr("Phases in their order"));
    setType(*m_list, Type::Body);
    constexpr int mostRows = 6;
    fitRows(*m_list, mostRows);
    column->addWidget(m_list);
    m_fields.bind("phases", tr("Phases"), *m_newKind);
    m_newKind->addItems(phaseKindNames());
    column->addLayout(actionsRow({m_newKind, m_add}));
    column->addLayout(actionsRow({m_up, m_down, m_remove}));
    column->addLayout(m_place);
    column->addStretch(1);
    connect(&fields, &DraftFields::replaced, this, &PhasesSection::present);
    connect(&fields, &DraftFields::edited, this, &PhasesSection::listPhases);
    connect(m_list, &QListWidget::currentRowChanged, this, [this](int row) {
        if (row >= 0 && row != m_chosen) choose(row);
    });
    connect(m_add, &QPushButton::clicked, this, &PhasesSection::add);
    connect(m_up, &QPushButton::clicked, this, [this] { move(-1); });
    connect(m_down, &QPushButton::clicked, this, [this] { move(+1); });
    connect(m_remove, &QPushButton::clicked, this, &PhasesSection::remove);
    present();
}

void PhasesSection::listPhases()
{
    QStringList rows;
    const ProtocolDraft& draft = m_fields.draft();
    for (std::size_t phase = 0; phase < draft.countAt("phases"); ++phase) {
        QStringList ids;
        constexpr std::size_t mostIds = 6;
        const std::size_t questions = draft.countAt(phasePlace(phase, "questions"));
        for (std::size_t i = 0; i < std::min(questions, mostIds); ++i)
            ids << QString::fromStdString(questionIdAt(draft, phase, i));
        if (questions > mostIds) ids << QStringLiteral("…");
        rows << tr("%1    %2: %3")
                    .arg(phase + 1)
                    .arg(ids.join(QStringLiteral(", ")), phaseKindNames().at(static_cast<int>(phaseKindOf(draft, phase))));
    }
    const QSignalBlocker quiet(m_list);
    while (m_list->count() > rows.size()) delete m_list->takeItem(m_list->count() - 1);
    for (int row = 0; row < rows.size(); ++row) {
        if (row >= m_list->count())
            m_list->addItem(rows[row]);
        else if (m_list->item(row)->text() != rows[row])
            m_list->item(row)->setText(rows[row]);
    }
    m_list->setCurrentRow(m_chosen);
}

void PhasesSection::present()
{
    const int phases = static_cast<int>(m_fields.draft().countAt("phases"));
    m_chosen = std::min(phases - 1, std::max(0, m_chosen));
    listPhases();
    const bool hasAny = phases > 0;
    for (QWidget* part : std::initializer_list<QWidget*>{m_list, m_up, m_down, m_remove}) part->setVisible(hasAny);
    m_up->setEnabled(m_chosen > 0);
    m_down->setEnabled(m_chosen + 1 < phases);
    showDetail();
}

void PhasesSection::showDetail()
{
    QWidget* focus = focusWidget();
    const QString focused = focus && m_detail && m_detail->isAncestorOf(focus) ? focus->objectName() : QString();
    if (m_detail) {
        m_fields.forget(*m_detail);
        // Hiding a field ends its editing; what was typed there belongs to the draft before.
        for (QObject* part : m_detail->findChildren<QObject*>()) part->blockSignals(true);
        m_detail->hide();
        m_detail->deleteLater();  // a control of it may have asked for this
        m_place->removeWidget(m_detail);
        m_detail = nullptr;
    }
    if (m_chosen < 0) return;
    m_detail = new PhaseDetail(m_fields, static_cast<std::size_t>(m_chosen), this);
    m_place->addWidget(m_detail);
    m_detail->show();
    orderTabs(*this);
    if (auto* same = focused.isEmpty() ? nullptr : m_detail->findChild<QWidget*>(focused)) same->setFocus();
}

void PhasesSection::commitField()
{
    auto* line = qobject_cast<QLineEdit*>(focusWidget());
    if (line && m_detail && m_detail->isAncestorOf(line)) Q_EMIT line->editingFinished();
}

void PhasesSection::choose(int phase)
{
    commitField();
    m_chosen = phase;
    present();
    Q_EMIT chosenChanged();
}

void PhasesSection::add()
{
    commitField();
    m_chosen = static_cast<int>(m_fields.draft().countAt("phases"));
    m_fields.change([this](ProtocolDraft& draft) { addPhase(draft, static_cast<PhaseKind>(m_newKind->currentIndex())); });
    Q_EMIT chosenChanged();
}

void PhasesSection::move(int step)
{
    commitField();
    const int from = m_chosen;
    m_chosen += step;
    m_fields.change([&](ProtocolDraft& draft) {
        exchangePhases(draft, static_cast<std::size_t>(from), static_cast<std::size_t>(from + step));
    });
    Q_EMIT chosenChanged();
}

void PhasesSection::remove()
{
    const auto phase = static_cast<std::size_t>(m_chosen);
    m_fields.change([&](ProtocolDraft& draft) { removePhase(draft, phase); });
    Q_EMIT chosenChanged();
}

QStringList phaseKindNames()
{
    return {PhasesSection::tr("choose the fabric among pieces"), PhasesSection::tr("rate with numbers"),
            PhasesSection::tr("rate with words"), PhasesSection::tr("same or different"), PhasesSection::tr("own words")};
}

}  // namespace study::app
