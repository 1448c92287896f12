#include "study/app/pages/editor/conditions_section.h"

#include <QComboBox>
#include <QFileDialog>
#include <QListWidget>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "protocols/condition.h"
#include "study/app/drafts/draft_edits.h"
#include "study/app/language/below.h"
#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/tick_box.h"

namespace study::app {

namespace {

/// A rendered condition in plain words.
struct Explained {
    const char* id;
    const char* sentence;
};
constexpr Explained explained[] = {
    {"v_grey", QT_TRANSLATE_NOOP("study::app::ConditionsSection", "The brightness of the photograph is felt as relief.")},
    {"v_shape",
     QT_TRANSLATE_NOOP("study::app::ConditionsSection", "Relief that is computed from the shading of the photograph.")},
    {"f_g", QT_TRANSLATE_NOOP("study::app::ConditionsSection", "Friction along the stroke, generated from the photograph.")},
    {"h_g", QT_TRANSLATE_NOOP("study::app::ConditionsSection", "Relief that is generated from the photograph.")},
    {"h_g&f_g",
     QT_TRANSLATE_NOOP("study::app::ConditionsSection", "Relief and mean friction, both generated from the photograph.")},
    {"t_grey",
     QT_TRANSLATE_NOOP("study::app::ConditionsSection", "The brightness of a tactile sensor's picture is felt as relief.")},
    {"f", QT_TRANSLATE_NOOP("study::app::ConditionsSection", "Friction that was measured along a stroke.")},
    {"h", QT_TRANSLATE_NOOP("study::app::ConditionsSection", "Relief that was measured with a tactile sensor.")},
    {"h&f", QT_TRANSLATE_NOOP("study::app::ConditionsSection", "Relief and mean friction, both measured.")},
    {"gradient",
     QT_TRANSLATE_NOOP("study::app::ConditionsSection", "Slope of the measured relief along the stroke; not in the paper.")},
};

QString sentenceFor(std::string_view id)
{
    const auto* found = std::ranges::find(explained, id, [](const Explained& one) { return std::string_view(one.id); });
    return found == std::end(explained) ? QString() : ConditionsSection::tr(found->sentence);
}

bool isPlainRow(const std::string& id)
{
    return std::ranges::any_of(protocols::allConditions(), [&](const protocols::Condition& row) { return row.id == id; });
}

}  // namespace

ConditionsSection::ConditionsSection(DraftFields& fields, QWidget* parent)
    : QWidget(parent),
      m_fields(fields),
      m_further(new QListWidget(this)),
      m_remove(button("removeConditionButton", tr("Remove"), this)),
      m_ownId(field("ownConditionField", tr("Name of your condition"), this)),
      m_ownFolder(field("ownFolderField", tr("Folder of its images"), this)),
      m_addOwn(button("addOwnButton", tr("Add your images"), this)),
      m_addProgram(button("addProgramButton", tr("Add your program"), this)),
      m_browse(button("browseOwnButton", tr("Browse…"), this)),
      m_row(choiceBox("qualityCondition", tr("Condition at another quality"), this)),
      m_quality(choiceBox("qualityChoice", tr("Quality"), this)),
      m_addQuality(button("addQualityButton", tr("Add this quality"), this)),
      m_message(new MessageBar("conditionsMessage", this))
{
    auto* column = new QVBoxLayout(this);
    column->setSpacing(8);
    addHead(*column, "conditionsTitle", tr("Conditions"), tr("Ways to turn a fabric into what the finger feels on the screen."));
    buildRendered(*column);
    buildFurther(*column);
    column->addStretch(1);
    connect(&fields, &DraftFields::replaced, this, &ConditionsSection::present);
    connect(m_remove, &QPushButton::clicked, this, &ConditionsSection::removeFurther);
    connect(m_addOwn, &QPushButton::clicked, this, [this] { addOwn(Made::InFolder); });
    connect(m_addProgram, &QPushButton::clicked, this, [this] { addOwn(Made::ByProgram); });
    connect(m_browse, &QPushButton::clicked, this, &ConditionsSection::browse);
    connect(m_addQuality, &QPushButton::clicked, this, &ConditionsSection::addQuality);
    for (QLineEdit* line : {m_ownId, m_ownFolder}) connect(line, &QLineEdit::textChanged, m_message, &MessageBar::clearMessage);
    orderTabs(*this);
    present();
}

void ConditionsSection::buildRendered(QVBoxLayout& column)
{
    for (const protocols::Condition& row : protocols::allConditions()) {
        const std::string id(row.id);
        const QString shown = QString::fromStdString(id), sentence = sentenceFor(id);
        auto* tick = new TickBox(this);
        name(*tick, ("condition " + id).c_str(), tr("Condition %1: %2").arg(shown, sentence));
        connect(tick, &TickBox::toggled, this,
                [this, id](bool isOn) { m_fields.edit({}, [&](ProtocolDraft& draft) { setCondition(draft, id, isOn); }); });
        auto* line = new QHBoxLayout;
        line->setSpacing(8);
        line->addWidget(tick, 0, Qt::AlignTop);
        auto* words = new QVBoxLayout;
        words->setSpacing(0);
        QLabel* title = label("conditionId", Type::Body, this, Weight::Bold);
        title->setText(shown);
        QLabel* text = quietLabel("conditionSentence", this, Type::Plain);
        text->setText(sentence);
        for (QLabel* caption : {title, text}) tick->takeClicksOf(*caption);
        words->addWidget(title);
        words->addWidget(text);
        line->addLayout(words, 1);
        column.addLayout(line);
        m_rendered.push_back({id, tick});
        if (m_rendered.size() == 1) m_fields.bind("conditions", tr("Conditions"), *tick);
    }
}

void ConditionsSection::buildFurther(QVBoxLayout& column)
{
    addSmallHead(column, "ownTitle", tr("Your own conditions"),
                 tr("A folder with one ready friction image a fabric: F01.png, F02.png, … Or a program, which you name when you "
                    "make the study with `vis2hap study new --program`. They are blinded and balanced like all others."));
    name(*m_further, "furtherConditions", tr("Further conditions of the study"));
    setType(*m_further, Type::Body);
    constexpr int mostRows = 6;
    fitRows(*m_further, mostRows);
    column.addWidget(m_further);
    column.addLayout(actionsRow({m_remove}));
    m_ownId->setPlaceholderText(tr("mine"));
    m_ownFolder->setPlaceholderText(tr("the folder with the images"));
    auto* names = new QHBoxLayout;
    names->setSpacing(10);
    names->addWidget(m_ownId, 1);
    names->addWidget(m_ownFolder, 2);
    column.addLayout(names);
    column.addWidget(m_message);
    column.addLayout(actionsRow({m_addOwn, m_browse, m_addProgram}));
    addSmallHead(column, "qualityTitle", tr("One condition at several qualities"),
                 tr("Quality trades computing time for exactness, so a study can compare its prices."));
    for (const protocols::Condition& row : protocols::allConditions())
        if (row.hasQuality()) m_row->addItem(QString::fromStdString(std::string(row.id)));
    for (const protocols::Quality quality : protocols::allQualities)
        m_quality->addItem(QString::fromStdString(std::string(nameOf(quality))));
    column.addLayout(actionsRow({m_row, m_quality, m_addQuality}));
}

void ConditionsSection::present()
{
    const std::vector<DraftCondition> conditions = conditionsOf(m_fields.draft());
    for (const Offered& offered : m_rendered) {
        const QSignalBlocker quiet(offered.tick);
        offered.tick->setChecked(
            std::ranges::any_of(conditions, [&](const DraftCondition& one) { return one.id == offered.id; }));
    }
    m_further->clear();
    m_places.clear();
    for (std::size_t place = 0; place < conditions.size(); ++place) {
        const DraftCondition& one = conditions[place];
        if (one.source.empty() && !one.byProgram && isPlainRow(one.id)) continue;
        m_places.push_back(place);
        const QString id = QString::fromStdString(one.id), source = QString::fromStdString(one.source);
        m_further->addItem(one.byProgram      ? tr("%1    by a program").arg(id)
                           : source.isEmpty() ? id
                                              : tr("%1    from %2").arg(id, source));
    }
    m_further->setVisible(m_further->count() > 0);
    m_remove->setVisible(m_further->count() > 0);
    if (m_further->count() > 0) m_further->setCurrentRow(0);
}

void ConditionsSection::browse()
{
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder of the images"), m_folder);
    if (chosen.isEmpty()) return;
    const bool isBeside = !m_folder.isEmpty() && chosen.startsWith(m_folder + QLatin1Char('/'));
    m_ownFolder->setText(isBeside ? chosen.mid(m_folder.size() + 1) : chosen);
    if (m_ownId->text().isEmpty()) m_ownId->setFocus();
}

void ConditionsSection::addOwn(Made made)
{
    const std::string id = m_ownId->text().trimmed().toStdString(), folder = m_ownFolder->text().trimmed().toStdString();
    const std::string fault = protocols::faultOfOwnId(id);
    if (id.empty() || !fault.empty()) {
        m_ownId->setFocus();
        m_message->showHint(id.empty() ? tr("Your condition has no name. Type one, such as mine.") : inOwnLanguage(fault));
        return;
    }
    if (folder.empty() && made == Made::InFolder) {
        m_ownFolder->setFocus();
        m_message->showHint(tr("No folder is given. Choose the folder that holds one image a fabric."));
        return;
    }
    m_ownId->clear();
    m_ownFolder->clear();
    m_fields.change([&](ProtocolDraft& draft) { addOwnCondition(draft, id, made == Made::InFolder ? folder : std::string()); });
}

void ConditionsSection::addQuality()
{
    const std::string id = (m_row->currentText() + QLatin1Char('@') + m_quality->currentText()).toStdString();
    m_fields.change([&](ProtocolDraft& draft) { setCondition(draft, id, true); });
}

void ConditionsSection::removeFurther()
{
    const int row = m_further->currentRow();
    if (row < 0) return;
    const std::size_t place = m_places[static_cast<std::size_t>(row)];
    m_fields.change([&](ProtocolDraft& draft) { draft.erase("conditions[" + std::to_string(place) + "]"); });
}

}  // namespace study::app
