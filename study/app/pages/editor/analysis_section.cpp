#include "study/app/pages/editor/analysis_section.h"

#include <QComboBox>
#include <QListWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "protocols/files/number_text.h"
#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

constexpr char boundsPlace[] = "equivalence_bounds";

}  // namespace

AnalysisSection::AnalysisSection(DraftFields& fields, QWidget* parent)
    : QWidget(parent),
      m_fields(fields),
      m_lower(field("lowerBound", tr("Lower bound of equivalence"), this)),
      m_upper(field("upperBound", tr("Upper bound of equivalence"), this)),
      m_list(new QListWidget(this)),
      m_remove(button("removeContrastButton", tr("Remove"), this)),
      m_primary(button("primaryContrastButton", tr("Make it the primary one"), this)),
      m_a(choiceBox("contrastFirst", tr("First condition of the contrast"), this)),
      m_b(choiceBox("contrastSecond", tr("Second condition of the contrast"), this)),
      m_add(button("addContrastButton", tr("Add the contrast"), this)),
      m_message(new MessageBar("analysisMessage", this))
{
    auto* column = new QVBoxLayout(this);
    column->setSpacing(10);
    addHead(*column, "analysisTitle", tr("Analysis"),
            tr("Decide before the first participant comes what the report tests first, and which difference is too small to "
               "matter."));
    auto* row = new FlowLayout(14, 8);
    column->addLayout(row);
    row->addWidget(captioned(tr("Equal from (scale points)"), *m_lower, this));
    row->addWidget(captioned(tr("to (scale points)"), *m_upper, this));
    fields.bind(boundsPlace, tr("Bounds of equivalence"), *m_lower);
    fields.bind(std::string(boundsPlace) + "[1]", tr("Upper bound of equivalence"), *m_upper);
    addSmallHead(*column, "contrastsTitle", tr("Planned contrasts"),
                 tr("Pairs of conditions. The primary one is tested first; without a choice it is the first."));
    name(*m_list, "plannedContrasts", tr("Planned contrasts"));
    setType(*m_list, Type::Body);
    constexpr int mostRows = 8;
    fitRows(*m_list, mostRows);
    column->addWidget(m_list);
    fields.bind("planned", tr("Planned contrasts"), *m_list);
    fields.bind("primary", tr("Primary contrast"), *m_primary);
    column->addLayout(actionsRow({m_primary, m_remove}));
    column->addLayout(actionsRow({m_a, m_b, m_add}));
    column->addWidget(m_message);
    column->addStretch(1);
    connect(&fields, &DraftFields::replaced, this, &AnalysisSection::present);
    connect(&fields, &DraftFields::edited, this, &AnalysisSection::offerConditions);
    connect(&fields, &DraftFields::edited, this, &AnalysisSection::showUsualBounds);
    for (QLineEdit* line : {m_lower, m_upper}) connect(line, &QLineEdit::textEdited, this, &AnalysisSection::takeBounds);
    connect(m_add, &QPushButton::clicked, this, &AnalysisSection::add);
    connect(m_remove, &QPushButton::clicked, this, &AnalysisSection::remove);
    connect(m_primary, &QPushButton::clicked, this, &AnalysisSection::makePrimary);
    orderTabs(*this);
    present();
}

void AnalysisSection::present()
{
    const ProtocolDraft& draft = m_fields.draft();
    const auto show = [&](QLineEdit& line, const char* element) {
        const QString text = withDecimalMark(QString::fromStdString(draft.typedAt(std::string(boundsPlace) + element)));
        if (line.text() != text) line.setText(text);
    };
    show(*m_lower, "[0]");
    show(*m_upper, "[1]");
    showUsualBounds();
    const int row = m_list->currentRow();
    m_list->clear();
    for (const DraftContrast& contrast : contrastsOf(draft)) {
        const QString pair = tr("%1 − %2").arg(QString::fromStdString(contrast.a), QString::fromStdString(contrast.b));
        m_list->addItem(contrast.isPrimary ? tr("%1    (primary)").arg(pair) : pair);
    }
    const bool hasAny = m_list->count() > 0;
    for (QWidget* part : std::initializer_list<QWidget*>{m_list, m_remove, m_primary}) part->setVisible(hasAny);
    if (hasAny) choose(std::clamp(row, 0, m_list->count() - 1));
    offerConditions();
}

void AnalysisSection::showUsualBounds()
{
    const double bound = usualBoundOf(m_fields.draft());
    m_lower->setPlaceholderText(withDecimalMark(QString::fromStdString(protocols::shortest(-bound))));
    m_upper->setPlaceholderText(withDecimalMark(QString::fromStdString(protocols::shortest(bound))));
}

void AnalysisSection::choose(int contrast) { m_list->setCurrentRow(std::min(contrast, m_list->count() - 1)); }

void AnalysisSection::offerConditions()
{
    QStringList ids;
    for (const DraftCondition& condition : conditionsOf(m_fields.draft())) ids << QString::fromStdString(condition.id);
    for (QComboBox* box : {m_a, m_b}) {
        QStringList shown;
        for (int item = 0; item < box->count(); ++item) shown << box->itemText(item);
        if (shown == ids) continue;
        const QString chosen = box->currentText();
        box->clear();
        box->addItems(ids);
        const int place = box->findText(chosen);
        box->setCurrentIndex(place >= 0 ? place : box == m_b && ids.size() > 1 ? 1 : ids.isEmpty() ? -1 : 0);
    }
    m_add->setEnabled(ids.size() > 1);
}

void AnalysisSection::takeBounds()
{
    m_fields.edit(boundsPlace, [&](ProtocolDraft& draft) {
        const std::string lower = m_lower->text().trimmed().toStdString(), upper = m_upper->text().trimmed().toStdString();
        if (lower.empty() && upper.empty())
            draft.erase(boundsPlace);
        else
            draft.set(boundsPlace, nlohmann::ordered_json::array({valueOfTyped(lower), valueOfTyped(upper)}));
    });
}

void AnalysisSection::add()
{
    const DraftContrast added{m_a->currentText().toStdString(), m_b->currentText().toStdString()};
    std::vector<DraftContrast> contrasts = contrastsOf(m_fields.draft());
    const bool isThere = std::ranges::any_of(contrasts, [&](const DraftContrast& one) {
        return (one.a == added.a && one.b == added.b) || (one.a == added.b && one.b == added.a);
    });
    m_message->clearMessage();
    if (added.a == added.b) return m_message->showHint(tr("Both conditions are the same. Choose two different ones."));
    if (isThere) return m_message->showHint(tr("This pair is planned already. Choose another one."));
    contrasts.push_back(added);
    m_fields.change([&](ProtocolDraft& draft) { setContrasts(draft, contrasts); });
    choose(m_list->count() - 1);
}

void AnalysisSection::remove()
{
    std::vector<DraftContrast> contrasts = contrastsOf(m_fields.draft());
    const int row = m_list->currentRow();
    if (row < 0) return;
    contrasts.erase(contrasts.begin() + row);
    m_fields.change([&](ProtocolDraft& draft) { setContrasts(draft, contrasts); });
}

void AnalysisSection::makePrimary()
{
    std::vector<DraftContrast> contrasts = contrastsOf(m_fields.draft());
    const int row = m_list->currentRow();
    if (row < 0) return;
    for (std::size_t i = 0; i < contrasts.size(); ++i) contrasts[i].isPrimary = static_cast<int>(i) == row;
    m_fields.change([&](ProtocolDraft& draft) { setContrasts(draft, contrasts); });
}

}  // namespace study::app
