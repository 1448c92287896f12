#include "study/app/pages/editor/editor_start.h"

#include <QFileDialog>
#include <QListWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "protocols/texts/shipped_texts.h"
#include "protocols/usual_texts.h"
#include "study/app/language/app_text.h"
#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

/// What an example is for, by the name of its file.
struct ExplainedExample {
    const char* name;
    const char* title;
    const char* sentence;
};
constexpr ExplainedExample explainedExamples[] = {
    {"two_choice_likert", QT_TRANSLATE_NOOP("study::app::EditorStart", "Two pieces and five words"),
     QT_TRANSLATE_NOOP("study::app::EditorStart", "One of two pieces, then how similar it is, in five words.")},
    {"same_different", QT_TRANSLATE_NOOP("study::app::EditorStart", "Same or different"),
     QT_TRANSLATE_NOOP("study::app::EditorStart", "Is the fabric the one on the screen? Blank glass finds guessers.")},
    {"speed_accuracy", QT_TRANSLATE_NOOP("study::app::EditorStart", "Speed against accuracy"),
     QT_TRANSLATE_NOOP("study::app::EditorStart", "The same choices under “be fast”, “be accurate” and a deadline.")},
    {"quality", QT_TRANSLATE_NOOP("study::app::EditorStart", "Quality of the rendering"),
     QT_TRANSLATE_NOOP("study::app::EditorStart", "One rendering at three prices in computing time.")},
    {"anchors", QT_TRANSLATE_NOOP("study::app::EditorStart", "Floor and ceiling of ratings"),
     QT_TRANSLATE_NOOP("study::app::EditorStart", "Some images come with another fabric, some twice.")},
    {"own_images", QT_TRANSLATE_NOOP("study::app::EditorStart", "Your own images"),
     QT_TRANSLATE_NOOP("study::app::EditorStart", "Friction images that you made, beside two renderings of the program.")},
    {"own_program", QT_TRANSLATE_NOOP("study::app::EditorStart", "Your own program"),
     QT_TRANSLATE_NOOP("study::app::EditorStart", "A program of yours makes the friction images, beside two renderings.")},
    {"teaching", QT_TRANSLATE_NOOP("study::app::EditorStart", "Exercise for a class"),
     QT_TRANSLATE_NOOP("study::app::EditorStart", "Simulated answers with planted effects and a careless participant.")},
    {"pilot", QT_TRANSLATE_NOOP("study::app::EditorStart", "Pilot of one participant"),
     QT_TRANSLATE_NOOP("study::app::EditorStart", "Shows whether the set-up works and how long a presentation takes.")},
};

QString shownName(std::string_view file)
{
    const auto* found =
        std::ranges::find(explainedExamples, file, [](const ExplainedExample& one) { return std::string_view(one.name); });
    if (found == std::end(explainedExamples)) return QString::fromUtf8(file.data(), static_cast<qsizetype>(file.size()));
    return EditorStart::tr("%1\n%2").arg(EditorStart::tr(found->title), EditorStart::tr(found->sentence));
}

QString qtText(std::string_view text) { return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size())); }

}  // namespace

EditorStart::EditorStart(QWidget* parent)
    : QWidget(parent),
      m_examples(new QListWidget(this)),
      m_begin(mainButton("beginProtocolButton", tr("Begin with this (Enter)"), this)),
      m_file(field("protocolFileField", tr("Protocol file"), this)),
      m_browse(button("browseProtocolButton", tr("Browse…"), this)),
      m_open(button("openProtocolButton", tr("Open the protocol"), this)),
      m_back(button("editorStartBackButton", tr("Back (Esc)"), this)),
      m_message(new MessageBar("editorStartMessage", this))
{
    auto* page = new QWidget(this);
    auto* title = label("editorStartTitle", Type::Title, page, Weight::Bold);
    title->setText(tr("Make a protocol"));
    auto* lead = quietLabel("editorStartLead", page);
    lead->setText(
        tr("A protocol says who feels what, in which order, and what is asked. A study that exists keeps its own; `vis2hap study "
           "amend` changes that."));
    name(*m_examples, "exampleList", tr("Begin with"));
    setType(*m_examples, Type::Body);
    m_examples->setWordWrap(true);
    m_examples->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_examples->setMinimumHeight(m_examples->fontMetrics().height() *
                                 5);  // a longer list scrolls, so that the buttons stay in view
    m_examples->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    addExamples();
    m_file->setPlaceholderText(tr("a protocol file to change, .json"));
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    column->addWidget(title);
    column->addWidget(lead);
    column->addWidget(m_examples, 1);
    column->addLayout(actionsRow({m_begin, m_back}));
    column->addSpacing(12);
    addSmallHead(*column, "changeTitle", tr("Change a protocol"));
    auto* row = new QHBoxLayout;
    row->setSpacing(10);
    row->addWidget(m_file, 1);
    row->addWidget(m_browse);
    row->addWidget(m_open);
    column->addLayout(row);
    column->addWidget(m_message);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("editorStartArea", page, this));
    orderTabs(*page);
    connect(m_begin, &QPushButton::clicked, this, &EditorStart::begin);
    connect(m_examples, &QListWidget::itemActivated, this, &EditorStart::begin);
    connect(m_browse, &QPushButton::clicked, this, &EditorStart::browse);
    connect(m_open, &QPushButton::clicked, this, &EditorStart::open);
    connect(m_back, &QPushButton::clicked, this, &EditorStart::backRequested);
    connect(m_file, &QLineEdit::textChanged, m_message, &MessageBar::clearMessage);
}

void EditorStart::addExamples()
{
    const auto add = [this](const QString& shown, const QString& text) {
        auto* item = new QListWidgetItem(shown, m_examples);
        item->setData(Qt::UserRole, text);
    };
    for (const protocols::shipped::TextFile& example : protocols::shipped::examples())
        add(shownName(example.name), qtText(example.json));
    add(tr("The study of the paper\n10 participants, 7 fabrics, 9 conditions, a choice among three pieces and three ratings."),
        qtText(protocols::paperProtocolIn(languageOfWindow().toStdString())));
    add(tr("Empty\nNothing is chosen yet."), QString());
    m_examples->setCurrentRow(0);
}

void EditorStart::focusFirst() { m_examples->setFocus(); }

void EditorStart::focusFile() { m_file->setFocus(); }

void EditorStart::showFault(const QString& text) { m_message->showFault(text); }

void EditorStart::accept()
{
    if (focusWidget() == m_file)
        open();
    else
        begin();
}

void EditorStart::begin()
{
    if (const QListWidgetItem* item = m_examples->currentItem()) Q_EMIT exampleChosen(item->data(Qt::UserRole).toString());
}

void EditorStart::browse()
{
    const QString chosen = QFileDialog::getOpenFileName(this, tr("Protocol file"), m_file->text(), tr("Protocols (*.json)"));
    if (chosen.isEmpty()) return;
    m_file->setText(chosen);
    open();
}

void EditorStart::open()
{
    const QString file = m_file->text().trimmed();
    if (!file.isEmpty()) {
        Q_EMIT fileChosen(file);
        return;
    }
    m_file->setFocus();
    m_message->showHint(tr("No file is given. Type a protocol file, or choose it with Browse."));
}

}  // namespace study::app
