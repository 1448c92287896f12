#include "study/app/pages/editor/plain_sections.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QPlainTextEdit>
#include <QVBoxLayout>

#include "protocols/usual_texts.h"
#include "study/app/drafts/draft_edits.h"
#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pages/editor/keyed_texts.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/tick_box.h"

namespace study::app {

namespace {

struct Section {
    Q_DECLARE_TR_FUNCTIONS(study::app::EditorSections)
};

QVBoxLayout* columnOf(QWidget& section)
{
    auto* column = new QVBoxLayout(&section);
    column->setSpacing(10);
    return column;
}

FlowLayout* addRow(QVBoxLayout& column)
{
    auto* row = new FlowLayout(14, 8);
    column.addLayout(row);
    return row;
}

QString usualHint(const std::string& text) { return Section::tr("empty: “%1”").arg(QString::fromStdString(text)); }

}  // namespace

QWidget* courseSection(DraftFields& fields, QWidget* parent)
{
    auto* section = new QWidget(parent);
    QVBoxLayout& column = *columnOf(*section);
    addHead(column, "courseTitle", Section::tr("Course of a session"),
            Section::tr("Empty fields have usual values, which they show."));
    FlowLayout& times = *addRow(column);
    fields.addShortLine(times, "seconds_per_presentation", Section::tr("Seconds a presentation"), FieldKind::Number,
                        QStringLiteral("25"));
    fields.addShortLine(times, "break_after", Section::tr("Presentations before a break"), FieldKind::Number,
                        QStringLiteral("21"));
    fields.addShortLine(times, "break_after_minutes", Section::tr("Minutes before a break"), FieldKind::Number,
                        Section::tr("no limit"));
    fields.addShortLine(times, "sitting_minutes", Section::tr("Minutes of a sitting"), FieldKind::Number, QStringLiteral("60"));
    addSmallHead(column, "trayTitle", Section::tr("Fabrics and tray"));
    FlowLayout& tray = *addRow(column);
    fields.addShortLine(tray, "familiarisation_fabrics", Section::tr("Fabrics to get used to"), FieldKind::Number,
                        QStringLiteral("0"));
    fields.addShortLine(tray, "dead_time_seconds", Section::tr("Seconds a new tray is locked"), FieldKind::Number,
                        QStringLiteral("0.7"));
    auto* codes = choiceBox("swatches", Section::tr("Codes on the fabric pieces"), section);
    codes->addItem(Section::tr("one set for the whole study"), QStringLiteral("once"));
    codes->addItem(Section::tr("new codes for each participant"), QStringLiteral("fresh"));
    fields.bind("swatches", Section::tr("Codes on the fabric pieces"), *codes);
    const auto showCodes = [&fields, codes] { codes->setCurrentIndex(fields.draft().typedAt("swatches") == "fresh" ? 1 : 0); };
    QObject::connect(&fields, &DraftFields::replaced, codes, showCodes);
    QObject::connect(codes, &QComboBox::activated, codes, [&fields, codes] {
        fields.edit({}, [&](ProtocolDraft& draft) { draft.set("swatches", codes->currentData().toString().toStdString()); });
    });
    tray.addWidget(captioned(Section::tr("Codes on the fabric pieces"), *codes, section));
    fields.addTick(column, "confirm_pieces", Section::tr("The operator scans or types the code of every piece"));
    fields.addTick(column, "second_entry", Section::tr("The operator enters every answer twice"));
    column.addStretch(1);
    orderTabs(*section);
    return section;
}

namespace {

void addKeyedTexts(DraftFields& fields, QVBoxLayout& column, QWidget* section)
{
    addSmallHead(column, "participantTextsTitle", Section::tr("Participant's screen"),
                 Section::tr("Choose a sentence and write your own. Names in braces, such as {time}, stay as they are."));
    column.addWidget(new KeyedTexts(fields,
                                    {"participant_texts",
                                     Section::tr("Sentences by their names"),
                                     Section::tr("Your sentence; empty: the usual one"),
                                     participantTextsOf,
                                     {}},
                                    section));
    addSmallHead(column, "promptsTitle", Section::tr("Recordings for the headphones"),
                 Section::tr("WAV files that lie beside the protocol. A computer voice says what has no recording."));
    column.addWidget(new KeyedTexts(fields,
                                    {"prompts", Section::tr("Prompts by their names"),
                                     Section::tr("File of the recording; empty: none"), promptsOf, QStringLiteral("wait.wav")},
                                    section));
}

}  // namespace

QWidget* textsSection(DraftFields& fields, QWidget* parent)
{
    constexpr auto current = protocols::ProtocolEdition::Current;
    auto* section = new QWidget(parent);
    QVBoxLayout& column = *columnOf(*section);
    addHead(column, "textsTitle", Section::tr("Texts"),
            Section::tr("The operator reads them aloud or ticks them. Write them in the language of your participants."));
    fields.addLine(column, "language", Section::tr("Language of the participants, as a tag"), FieldKind::Text,
                   Section::tr("en; others are de, pt-BR, zh-CN"));
    auto* consent = fields.addLines(column, "consent", Section::tr("Consent, which the operator confirms"), FieldKind::Text);
    auto* stroke = fields.addLines(column, "stroke_words", Section::tr("How to stroke glass and fabric"), FieldKind::Text);
    const auto showUsual = [&fields, consent, stroke] {
        const std::string language = languageOf(fields.draft());
        consent->setPlaceholderText(usualHint(protocols::usualConsent(current, language)));
        stroke->setPlaceholderText(usualHint(protocols::usualStrokeWords(current, language)));
    };
    QObject::connect(&fields, &DraftFields::edited, section, showUsual);
    showUsual();
    fields.addLines(column, "checklist", Section::tr("Checklist before a sitting, one point a line"), FieldKind::Lines,
                    Section::tr("The participant wears the eye mask"));
    fields.addLines(column, "readings", Section::tr("Readings before a sitting, one quantity with its unit a line"),
                    FieldKind::Lines, Section::tr("temperature in °C"));
    fields.addLines(column, "facts", Section::tr("Facts that the participant may give, one a line"), FieldKind::Lines,
                    Section::tr("age"));
    addKeyedTexts(fields, column, section);
    column.addStretch(1);
    orderTabs(*section);
    return section;
}

}  // namespace study::app
