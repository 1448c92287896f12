#include "study/app/correction_panel.h"

#include "study/app/pieces.h"
#include "study/app/rating_field.h"
#include "study/app/rating_text.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>

namespace study::app {

using protocols::Tenths;

CorrectionPanel::CorrectionPanel(QWidget* parent)
    : StagePage(parent),
      m_questionsRow(new QHBoxLayout),
      m_old(label("oldValue", Type::Lead, this)),
      m_rating(new RatingField("newRatingField", tr("New rating"), this)),
      m_choicesColumn(new QVBoxLayout),
      m_why(field("whyField", tr("Why it is corrected"), this)),
      m_action(mainButton("panelConfirmButton", tr("Store the correction (Enter)"), this)),
      m_back(button("panelBackButton", tr("Back (Esc)"), this))
{
    auto* title = label("panelTitle", Type::Title, this, Weight::Bold);
    title->setText(tr("Correct an answer"));
    auto* explanation = quietLabel("panelExplanation", this);
    explanation->setText(tr("The old answer stays in the record beside the new one."));
    m_old->setContentsMargins(0, 4, 0, 0);
    setType(*m_rating, Type::Lead, Weight::Bold);
    m_choicesColumn->setSpacing(8);

    auto* newValue = new QVBoxLayout;
    newValue->addWidget(m_rating, 0, Qt::AlignLeft);
    newValue->addLayout(m_choicesColumn);
    auto* form = new QGridLayout;
    form->setHorizontalSpacing(18);
    form->setVerticalSpacing(14);
    form->setColumnStretch(1, 1);
    const auto addRow = [&](const QString& text, auto* control) {
        auto* caption = quietLabel("correctionCaption", this);
        caption->setText(text);
        caption->setWordWrap(false);
        caption->setContentsMargins(0, 7, 0, 0);  // level with the text in the fields
        const int row = form->rowCount();
        form->addWidget(caption, row, 0, Qt::AlignTop);
        if constexpr (std::is_base_of_v<QLayout, std::remove_pointer_t<decltype(control)>>)
            form->addLayout(control, row, 1);
        else
            form->addWidget(control, row, 1);
    };
    m_questionsRow->setSpacing(8);
    addRow(tr("Answer to"), m_questionsRow);
    addRow(tr("Stored is"), m_old);
    addRow(tr("It shall be"), newValue);
    addRow(tr("Because"), m_why);

    auto* actions = new QHBoxLayout;
    actions->setSpacing(14);
    actions->addWidget(m_action);
    actions->addWidget(m_back);
    actions->addStretch(1);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(16);
    column->addWidget(title);
    column->addWidget(explanation);
    column->addLayout(form);
    column->addLayout(actions);
    column->addStretch(1);
    connect(m_action, &QPushButton::clicked, this, &CorrectionPanel::confirm);
    connect(m_back, &QPushButton::clicked, this, &CorrectionPanel::closeAsked);
}

void CorrectionPanel::ask(const std::vector<Correctable>& answers)
{
    m_correctables = answers;
    showQuestions();
    m_why->clear();
    m_isReasonAskedAgain = false;
    showAnswer(0);
}

void CorrectionPanel::showQuestions()
{
    qDeleteAll(m_questions);
    m_questions.clear();
    delete m_questionsRow->takeAt(0);  // the stretch behind the last ones
    for (std::size_t place = 0; place < m_correctables.size(); ++place) {
        const QString question = QString::fromStdString(m_correctables[place].question.value);
        auto* choice = button(qPrintable(QStringLiteral("answerTo") + question), question, this);
        choice->setAccessibleName(tr("Correct the answer to %1").arg(question));
        choice->setCheckable(true);
        connect(choice, &QPushButton::clicked, this, [this, place] { showAnswer(place); });
        m_questionsRow->addWidget(choice);
        choice->show();
        m_questions.push_back(choice);
    }
    m_questionsRow->addStretch(1);
}

const Correctable& CorrectionPanel::chosenAnswer() const
{
    return m_correctables.at(m_which);
}

void CorrectionPanel::showAnswer(std::size_t place)
{
    m_which = place;
    for (std::size_t i = 0; i < m_questions.size(); ++i)
        m_questions[i]->setChecked(i == place);
    const Correctable& answer = chosenAnswer();
    m_old->setText(answer.current);
    m_rating->clear();
    m_rating->setVisible(answer.scale.has_value());
    showChoices(answer);
    firstFocus().setFocus();
}

void CorrectionPanel::showChoices(const Correctable& answer)
{
    qDeleteAll(m_choices);
    m_choices.clear();
    m_chosen.reset();
    QWidget* before = m_rating;
    for (std::size_t place = 0; place < answer.choices.size(); ++place) {
        auto* choice = button(qPrintable(QStringLiteral("newAnswer%1").arg(slotLetter(place))), answer.choices[place].name, this);
        setRole(*choice, "answer");
        choice->setCheckable(true);
        connect(choice, &QPushButton::clicked, this, [this, place] { choose(place); });
        m_choicesColumn->addWidget(choice);
        choice->show();
        m_choices.push_back(choice);
        setTabOrder(before, choice);
        before = choice;
    }
    setTabOrder(before, m_why);
}

void CorrectionPanel::choose(std::size_t place)
{
    m_chosen = place;
    for (std::size_t i = 0; i < m_choices.size(); ++i)
        m_choices[i]->setChecked(i == place);
    m_why->setFocus();
}

std::optional<session::Response> CorrectionPanel::newResponse()
{
    const Correctable& answer = chosenAnswer();
    if (answer.scale) {
        const auto typed = ratingFromText(m_rating->text(), *answer.scale);
        if (const auto* rating = std::get_if<Tenths>(&typed))
            return *rating;
        m_rating->setFocus();
        Q_EMIT hinted(std::get<NoRating>(typed).why);
    } else if (m_chosen) {
        return answer.choices[*m_chosen].fabric;
    } else {
        firstFocus().setFocus();
        Q_EMIT hinted(tr("Choose the right answer first: press its letter."));
    }
    return std::nullopt;
}

void CorrectionPanel::confirm()
{
    const auto response = newResponse();
    if (!response)
        return;
    const bool isEmpty = m_why->text().trimmed().isEmpty();
    if (!isEmpty || m_isReasonAskedAgain) {
        const std::string why = isEmpty ? std::string() : m_why->text().toStdString();
        Q_EMIT eventAsked(session::Corrected{chosenAnswer().question, *response, why});
        return;
    }
    m_isReasonAskedAgain = true;
    m_why->setFocus();
    Q_EMIT hinted(tr("Say why, in a few words such as “misheard”. Enter once more stores it without a reason."));
}

bool CorrectionPanel::pressKey(int key)
{
    const int place = key - Qt::Key_A;
    if (isEnter(key))
        confirm();
    else if (key == Qt::Key_Escape)
        Q_EMIT closeAsked();
    else if (place >= 0 && place < static_cast<int>(m_choices.size()))
        choose(static_cast<std::size_t>(place));
    else
        return false;
    return true;
}

QWidget& CorrectionPanel::firstFocus()
{
    if (chosenAnswer().scale)
        return *m_rating;
    return *m_choices.front();
}

}  // namespace study::app
