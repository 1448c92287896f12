#include "study/app/pages/editor/study_section.h"

#include <QFileDialog>
#include <QListWidget>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

constexpr char fabricsPlace[] = "fabrics";

QStringList idsIn(const QString& typed)
{
    QStringList ids;
    for (const QString& part : typed.split(QLatin1Char(','), Qt::SkipEmptyParts))
        if (const QString id = part.trimmed(); !id.isEmpty()) ids << id;
    return ids;
}

QString typedFabrics(const ProtocolDraft& draft)
{
    return QString::fromStdString(draft.typedAt(fabricsPlace)).replace(QLatin1Char('\n'), QStringLiteral(", "));
}

}  // namespace

StudySection::StudySection(DraftFields& fields, LookAtData look, QWidget* parent)
    : QWidget(parent),
      m_fields(fields),
      m_look(std::move(look)),
      m_fabrics(field(fabricsPlace, tr("Fabrics"), this)),
      m_browse(button("chooseFabricsButton", tr("Choose fabrics of a data set…"), this)),
      m_list(new QListWidget(this)),
      m_message(new MessageBar("fabricsMessage", this))
{
    auto* column = new QVBoxLayout(this);
    column->setSpacing(10);
    addHead(*column, "studyTitle", tr("Study"),
            tr("Every participant feels each fabric under each condition. The numbers beside show what that takes."));
    fields.addLine(*column, "name", tr("Name of the study"), FieldKind::Text, tr("Five words for five fabrics"));
    auto* row = new FlowLayout(14, 8);
    column->addLayout(row);
    fields.addShortLine(*row, "participants", tr("Participants"), FieldKind::Number, QStringLiteral("10"));
    addCaptioned(*column, tr("Fabrics: a number, which are drawn from the data set, or ids with commas"), *m_fabrics);
    m_fabrics->setPlaceholderText(tr("5, or F01, F04, F07"));
    fields.bind(fabricsPlace, tr("Fabrics"), *m_fabrics);
    column->addLayout(actionsRow({m_browse}));
    m_browse->setVisible(static_cast<bool>(m_look));
    column->addWidget(m_message);
    name(*m_list, "fabricList", tr("Fabrics of the data set; Space chooses"));
    setType(*m_list, Type::Body);
    constexpr int mostRows = 8;
    fitRows(*m_list, mostRows);
    m_list->hide();
    column->addWidget(m_list);
    column->addStretch(1);
    connect(m_fabrics, &QLineEdit::textEdited, this, &StudySection::takeTyped);
    connect(m_browse, &QPushButton::clicked, this, &StudySection::browse);
    connect(m_list, &QListWidget::itemChanged, this, &StudySection::takeTicked);
    connect(&fields, &DraftFields::replaced, this, &StudySection::showFabrics);
    orderTabs(*this);
    showFabrics();
}

void StudySection::browse()
{
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Fabric data set"));
    if (!folder.isEmpty()) readDataset(folder.toStdString());
}

void StudySection::readDataset(const std::filesystem::path& folder)
{
    m_message->clearMessage();
    m_reading.run(
        [this, folder, open = m_look.open](const std::atomic<bool>&) -> InBackground::Then {
            return [this, data = open(folder)] { listFabrics(data); };
        },
        [this](const QString& why) { m_message->showFault(why); });
}

void StudySection::listFabrics(const DataOverview& dataset)
{
    const QSignalBlocker quiet(m_list);
    m_list->clear();
    for (const DataOverview::Fabric& fabric : dataset.fabrics) {
        auto* item = new QListWidgetItem(fabric.name.isEmpty() ? fabric.id : fabric.id + QStringLiteral("    ") + fabric.name);
        item->setData(Qt::UserRole, fabric.id);
        item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
        item->setCheckState(Qt::Unchecked);
        m_list->addItem(item);
    }
    m_list->show();
    tickChosen();
    m_list->setCurrentRow(0);
    m_list->setFocus();
}

void StudySection::tickChosen()
{
    const QSignalBlocker quiet(m_list);
    const QStringList chosen = idsIn(m_fabrics->text());
    for (int row = 0; row < m_list->count(); ++row) {
        QListWidgetItem& item = *m_list->item(row);
        item.setCheckState(chosen.contains(item.data(Qt::UserRole).toString()) ? Qt::Checked : Qt::Unchecked);
    }
}

void StudySection::showFabrics()
{
    if (const QString typed = typedFabrics(m_fields.draft()); typed != m_fabrics->text()) m_fabrics->setText(typed);
    tickChosen();
}

void StudySection::takeTyped(const QString& typed)
{
    m_fields.edit(fabricsPlace, [&](ProtocolDraft& draft) {
        const auto value = valueOfTyped(typed.toStdString());
        if (typed.trimmed().isEmpty())
            draft.erase(fabricsPlace);
        else if (value.is_number())
            draft.set(fabricsPlace, value);
        else
            draft.setTyped(fabricsPlace, FieldKind::Lines, idsIn(typed).join(QLatin1Char('\n')).toStdString());
    });
    tickChosen();
}

void StudySection::takeTicked()
{
    QStringList ids;
    for (int row = 0; row < m_list->count(); ++row)
        if (m_list->item(row)->checkState() == Qt::Checked) ids << m_list->item(row)->data(Qt::UserRole).toString();
    m_fabrics->setText(ids.join(QStringLiteral(", ")));
    takeTyped(m_fabrics->text());
}

}  // namespace study::app
