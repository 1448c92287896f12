#include "study/app/pages/editor/phase_detail.h"

#include <QComboBox>
#include <QPlainTextEdit>
#include <QVBoxLayout>
#include <algorithm>

#include "protocols/usual_texts.h"
#include "study/app/drafts/draft_edits.h"
#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pages/editor/phases_section.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/tick_box.h"

namespace study::app {

namespace {

/// Rows of more questions than a session can ask would only make the page slow.
constexpr std::size_t mostShown = 40;
constexpr std::size_t mostInstructions = 6;  // as the schema has it

FlowLayout* addFlow(QVBoxLayout& column)
{
    auto* row = new FlowLayout(14, 8);
    column.addLayout(row);
    return row;
}

protocols::AnswerKind taskOfKind(const ProtocolDraft& draft, std::size_t phase)
{
    switch (phaseKindOf(draft, phase)) {
        case PhaseKind::Choice: {
            const auto& pieces = draft.at(phasePlace(phase, "alternatives"));
            return protocols::ForcedChoice{pieces.is_number_integer() ? std::clamp(pieces.get<int>(), 2, 26) : 3};
        }
        case PhaseKind::SameDifferent:
            return protocols::SameDifferent{};
        case PhaseKind::Numbers:
        case PhaseKind::Words:
        case PhaseKind::OwnWords:
            break;
    }
    return protocols::Rating{};
}

/// The words of a scale, with ends and step that fit their number.
void setWords(ProtocolDraft& draft, std::size_t phase, const QString& typed)
{
    draft.setTyped(phasePlace(phase, "scale.labels"), FieldKind::Lines, typed.toStdString());
    if (!draft.has(phasePlace(phase, "scale.labels")))
        draft.set(phasePlace(phase, "scale.labels"), nlohmann::ordered_json::array());
    const auto count = static_cast<double>(draft.countAt(phasePlace(phase, "scale.labels")));
    const auto numberAt = [&](const char* key, double usual) {
        const auto& value = draft.at(phasePlace(phase, key));
        return value.is_number() ? value.get<double>() : usual;
    };
    const double from = numberAt("scale.min", 1), step = numberAt("scale.step", 1);
    draft.set(phasePlace(phase, "scale.max"), valueOfTyped(std::to_string(from + std::max(1.0, count - 1) * step)));
}

}  // namespace

PhaseDetail::PhaseDetail(DraftFields& fields, std::size_t phase, QWidget* parent)
    : QWidget(parent), m_fields(fields), m_phase(phase)
{
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(10);
    addSmallHead(*column, "phaseTitle", tr("Phase %1").arg(phase + 1));
    addKind(*column);
    addQuestions(*column);
    addInstructions(*column);
}

std::string PhaseDetail::place(const std::string& key) const { return phasePlace(m_phase, key); }

void PhaseDetail::addKind(QVBoxLayout& column)
{
    const PhaseKind kind = phaseKindOf(m_fields.draft(), m_phase);
    auto* kinds = choiceBox("phaseKind", tr("Answers of phase %1").arg(m_phase + 1), this);
    kinds->addItems(phaseKindNames());
    kinds->setCurrentIndex(static_cast<int>(kind));
    m_fields.bind(phasePlace(m_phase), tr("Phase %1").arg(m_phase + 1), *kinds);
    connect(kinds, &QComboBox::activated, this, [this, kind](int chosen) {
        if (static_cast<PhaseKind>(chosen) == kind) return;
        m_fields.change([&](ProtocolDraft& draft) { setPhaseKind(draft, m_phase, static_cast<PhaseKind>(chosen)); });
    });
    FlowLayout& row = *addFlow(column);
    row.addWidget(captioned(tr("The participant answers"), *kinds, this));
    if (kind == PhaseKind::Choice)
        m_fields.addShortLine(row, place("alternatives"), tr("Pieces on the tray"), FieldKind::Number, QStringLiteral("3"));
    m_fields.addShortLine(row, place("catch_trials"), tr("Presentations of blank glass"), FieldKind::Number, QStringLiteral("0"));
    m_fields.addShortLine(row, place("anchors.mismatched"), tr("Anchors with another fabric"), FieldKind::Number,
                          QStringLiteral("0"));
    m_fields.addShortLine(row, place("anchors.repeated"), tr("Anchors felt twice"), FieldKind::Number, QStringLiteral("0"));
    if (kind == PhaseKind::Choice)
        m_fields.addTick(column, place("few_swaps"), tr("Leave as many pieces as possible on the tray from one to the next"));
    if (kind == PhaseKind::Numbers) addScale(column);
    if (kind == PhaseKind::Words) addWords(column);
}

void PhaseDetail::addScale(QVBoxLayout& column)
{
    FlowLayout& row = *addFlow(column);
    m_fields.addShortLine(row, place("scale.min"), tr("From"), FieldKind::Number, QStringLiteral("0"));
    m_fields.addShortLine(row, place("scale.max"), tr("To"), FieldKind::Number, QStringLiteral("10"));
    m_fields.addShortLine(row, place("scale.step"), tr("In steps of"), FieldKind::Number, QStringLiteral("0.1"));
    m_fields.addShortLine(row, place("scale.sections"), tr("Equal parts of the line"), FieldKind::Number, QStringLiteral("9"));
}

void PhaseDetail::addWords(QVBoxLayout& column)
{
    auto* words = new QPlainTextEdit(this);
    const QString caption = tr("Words of the scale, one a line, the lowest first");
    name(*words, place("scale.labels").c_str(), caption);
    setType(*words, Type::Body);
    words->setTabChangesFocus(true);
    words->setPlainText(QString::fromStdString(m_fields.draft().typedAt(place("scale.labels"))));
    constexpr int shownLines = 6;
    words->setFixedHeight(shownLines * words->fontMetrics().lineSpacing() + 26);
    m_fields.bind(place("scale"), caption, *words);
    connect(words, &QPlainTextEdit::textChanged, this, [this, words] {
        m_fields.edit(place("scale.labels"), [&](ProtocolDraft& draft) { setWords(draft, m_phase, words->toPlainText()); });
    });
    addCaptioned(column, caption, *words);
}

void PhaseDetail::addQuestions(QVBoxLayout& column)
{
    addSmallHead(column, "questionsTitle", tr("Questions of this phase"),
                 tr("A short name for tables, such as Soft, and the sentence that the operator says."));
    const std::size_t questions = m_fields.draft().countAt(place("questions"));
    for (std::size_t i = 0; i < std::min(questions, mostShown); ++i) addQuestion(column, i);
    if (questions > mostShown) {
        QLabel* more = quietLabel("moreQuestions", this);
        more->setText(tr("%1 more questions are kept and not shown.").arg(questions - mostShown));
        column.addWidget(more);
    }
    auto* add = button("addQuestionButton", tr("Add a question"), this);
    m_fields.bind(place("questions"), tr("Questions of phase %1").arg(m_phase + 1), *add);
    connect(add, &QPushButton::clicked, this,
            [this] { m_fields.change([this](ProtocolDraft& draft) { study::app::addQuestion(draft, m_phase); }); });
    column.addLayout(actionsRow({add}));
}

void PhaseDetail::addQuestion(QVBoxLayout& column, std::size_t question)
{
    const ProtocolDraft& draft = m_fields.draft();
    const std::string id = questionIdAt(draft, m_phase, question);
    const std::string itsPlace = place("questions") + "[" + std::to_string(question) + "]";
    const QString number = QString::number(question + 1);
    auto* row = new QHBoxLayout;
    row->setSpacing(10);
    QLineEdit* name = field(itsPlace.c_str(), tr("Name of question %1").arg(number), this);
    name->setText(QString::fromStdString(id));
    m_fields.bind(itsPlace, tr("Question %1 of phase %2").arg(question + 1).arg(m_phase + 1), *name);
    QLineEdit* sentence = field((itsPlace + ".text").c_str(), tr("Sentence of question %1").arg(number), this);
    sentence->setText(QString::fromStdString(sentenceOf(draft, id)));
    const auto showUsual = [this, sentence](const std::string& shownId) {
        const std::string usual = protocols::usualTextOf(protocols::QuestionId(shownId), taskOfKind(m_fields.draft(), m_phase),
                                                         protocols::ProtocolEdition::Current, languageOf(m_fields.draft()));
        sentence->setPlaceholderText(usual.empty() ? tr("How soft does the screen feel, compared with the fabric?")
                                                   : QString::fromStdString(usual));
    };
    showUsual(id);
    m_fields.bind(itsPlace + ".text", tr("Sentence of question %1 of phase %2").arg(question + 1).arg(m_phase + 1), *sentence);
    row->addWidget(name, 1);
    row->addWidget(sentence, 4);
    column.addLayout(row);
    // The name is taken when it is complete: half a name may be that of another question.
    connect(name, &QLineEdit::editingFinished, this, [this, name, question, showUsual] {
        const std::string typed = name->text().trimmed().toStdString();
        if (typed == questionIdAt(m_fields.draft(), m_phase, question)) return;
        m_fields.edit({}, [&](ProtocolDraft& changed) { renameQuestion(changed, m_phase, question, typed); });
        showUsual(typed);
    });
    connect(sentence, &QLineEdit::textEdited, this, [this, itsPlace, question](const QString& text) {
        m_fields.edit(itsPlace + ".text", [&](ProtocolDraft& changed) {
            setSentence(changed, questionIdAt(changed, m_phase, question), text.trimmed().toStdString());
        });
    });
    const PhaseKind kind = phaseKindOf(draft, m_phase);
    auto* actions = new QHBoxLayout;
    actions->setSpacing(8);
    if (kind != PhaseKind::OwnWords) {
        auto* own = new TickBox(this);
        study::app::name(*own, (itsPlace + ".own").c_str(), tr("Question %1 is answered in own words").arg(number));
        own->setChecked(isInOwnWords(draft, m_phase, id));
        connect(own, &TickBox::toggled, this, [this, question](bool isOn) {
            m_fields.change(
                [&](ProtocolDraft& changed) { setInOwnWords(changed, m_phase, questionIdAt(changed, m_phase, question), isOn); });
        });
        QLabel* caption = quietLabel("ownWordsCaption", this, Type::Plain);
        caption->setText(tr("answered in own words"));
        caption->setWordWrap(false);
        own->takeClicksOf(*caption);
        actions->addWidget(own);
        actions->addWidget(caption);
    }
    actions->addStretch(1);
    auto* remove = plainButton((itsPlace + ".remove").c_str(), tr("Remove question %1").arg(number), this);
    connect(remove, &QPushButton::clicked, this,
            [this, question] { m_fields.change([&](ProtocolDraft& changed) { removeQuestion(changed, m_phase, question); }); });
    actions->addWidget(remove);
    column.addLayout(actions);
}

void PhaseDetail::addInstructions(QVBoxLayout& column)
{
    addSmallHead(column, "instructionsTitle", tr("Speed or accuracy"),
                 tr("Without instructions the phase runs once. With them it runs once under each, in balanced orders."));
    const std::size_t count = m_fields.draft().countAt(place("instructions"));
    for (std::size_t i = 0; i < std::min(count, mostInstructions); ++i) addInstruction(column, i);
    auto* add = button("addInstructionButton", tr("Add an instruction"), this);
    add->setEnabled(count < mostInstructions);
    m_fields.bind(place("instructions"), tr("Instructions of phase %1").arg(m_phase + 1), *add);
    connect(add, &QPushButton::clicked, this, [this, count] {
        m_fields.change([&](ProtocolDraft& draft) {
            const bool isFirst = count == 0;
            nlohmann::ordered_json added{{"id", isFirst      ? "speed"
                                                : count == 1 ? "accuracy"
                                                             : "block" + std::to_string(count + 1)}};
            if (count < 2) added["aim"] = isFirst ? "speed" : "accuracy";
            draft.set(place("instructions") + "[" + std::to_string(count) + "]", added);
        });
    });
    column.addLayout(actionsRow({add}));
}

void PhaseDetail::addInstruction(QVBoxLayout& column, std::size_t instruction)
{
    const std::string its = place("instructions") + "[" + std::to_string(instruction) + "]";
    FlowLayout& row = *addFlow(column);
    m_fields.addShortLine(row, its + ".id", tr("Name of instruction %1").arg(instruction + 1), FieldKind::Text);
    auto* aim = choiceBox((its + ".aim").c_str(), tr("Aim of instruction %1").arg(instruction + 1), this);
    aim->addItem(tr("neither"), QString());
    aim->addItem(tr("be fast"), QStringLiteral("speed"));
    aim->addItem(tr("be accurate"), QStringLiteral("accuracy"));
    aim->setCurrentIndex(std::max(0, aim->findData(QString::fromStdString(m_fields.draft().typedAt(its + ".aim")))));
    m_fields.bind(its + ".aim", tr("Aim of instruction %1").arg(instruction + 1), *aim);
    connect(aim, &QComboBox::activated, this, [this, aim, its] {
        m_fields.edit({}, [&](ProtocolDraft& draft) {
            draft.setTyped(its + ".aim", FieldKind::Text, aim->currentData().toString().toStdString());
        });
    });
    row.addWidget(captioned(tr("Aim"), *aim, this));
    m_fields.addShortLine(row, its + ".deadline_seconds", tr("Seconds for an answer"), FieldKind::Number, tr("no limit"));
    auto* remove = plainButton((its + ".remove").c_str(), tr("Remove instruction %1").arg(instruction + 1), this);
    connect(remove, &QPushButton::clicked, this, [this, its] {
        m_fields.change([&](ProtocolDraft& draft) {
            draft.erase(its);
            if (draft.countAt(place("instructions")) == 0) draft.erase(place("instructions"));
        });
    });
    m_fields.addLine(column, its + ".text", tr("What the operator says"), FieldKind::Text, tr("empty: the usual sentence"));
    column.addLayout(actionsRow({remove}));
}

}  // namespace study::app
