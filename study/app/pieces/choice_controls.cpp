#include "study/app/pieces/choice_controls.h"

#include <QPushButton>
#include <QVBoxLayout>

#include "study/app/pieces/pieces.h"

namespace study::app {

ChoiceControls::ChoiceControls(QWidget* parent) : EntryControls(parent), m_column(new QVBoxLayout(this))
{
    setObjectName("choiceControls");
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Answers to choose by letter"));
    m_column->setContentsMargins(0, 0, 0, 0);
    m_column->setSpacing(8);
}

void ChoiceControls::ask(const AnswerForm& form)
{
    m_options = std::get<OptionsForm>(form).options;
    m_chosen.reset();
    for (std::size_t place = 0; place < m_options.size(); ++place) {
        const AnswerOption& option = m_options[place];
        QPushButton* made = buttonAt(place);
        made->setObjectName(QStringLiteral("answer") + option.letter);
        setButtonText(*made, QStringLiteral("%1    %2").arg(option.letter, option.name));
        made->setChecked(false);
        made->show();
    }
    // Buttons are reused for the next tray, because making a button takes longer than showing one.
    for (std::size_t place = m_options.size(); place < m_buttons.size(); ++place) {
        m_buttons[place]->setObjectName("answerLeftOver");
        m_buttons[place]->hide();
    }
    Q_EMIT changed();
}

QPushButton* ChoiceControls::buttonAt(std::size_t place)
{
    if (place < m_buttons.size()) return m_buttons[place];
    auto* made = button("", {}, this);
    setRole(*made, "answer");
    setType(*made, Type::Lead, Weight::Bold);
    made->setCheckable(true);
    connect(made, &QPushButton::clicked, this, [this, place] { choose(place); });
    m_column->addWidget(made);
    m_buttons.push_back(made);
    return made;
}

void ChoiceControls::choose(std::size_t place)
{
    m_chosen = place;
    for (std::size_t i = 0; i < m_buttons.size(); ++i) m_buttons[i]->setChecked(i == place);
    setFocus();
    Q_EMIT changed();
}

std::variant<session::GivenAnswer, NoAnswer> ChoiceControls::give()
{
    if (m_chosen) return m_options[*m_chosen].response;
    return NoAnswer{tr("No answer is chosen. Press the letter that the participant says.")};
}

ReadBack ChoiceControls::readBack() const
{
    if (!m_chosen) return {tr("Press the letter that the participant says.")};
    return {tr("Read back: %1").arg(m_options[*m_chosen].readBack), true};
}

bool ChoiceControls::pressKey(int key)
{
    for (std::size_t place = 0; place < m_options.size(); ++place) {
        const bool isDigit = key == Qt::Key_1 + static_cast<int>(place) && place < 9;
        if (!isDigit && key != m_options[place].letter.front().unicode()) continue;
        choose(place);
        return true;
    }
    return false;
}

}  // namespace study::app
