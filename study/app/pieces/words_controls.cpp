#include "study/app/pieces/words_controls.h"

#include <QVBoxLayout>

#include "study/app/pieces/words_field.h"

namespace study::app {

WordsControls::WordsControls(QWidget* parent)
    : EntryControls(parent), m_words(new WordsField("wordsField", tr("Answer of the participant in words"), this))
{
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(m_words);
    connect(m_words, &QPlainTextEdit::textChanged, this, [this] {
        m_isAskedAgain = false;
        Q_EMIT changed();
    });
}

void WordsControls::ask(const AnswerForm&)
{
    m_words->clear();
    m_isAskedAgain = false;
    Q_EMIT changed();
}

std::variant<session::GivenAnswer, NoAnswer> WordsControls::give()
{
    if (!m_words->words().isEmpty() || m_isAskedAgain) return session::Words{m_words->words().toStdString()};
    m_isAskedAgain = true;
    return NoAnswer{tr("The answer is empty. Press Enter again to store an answer without words.")};
}

ReadBack WordsControls::readBack() const
{
    return {tr("Write the words of the participant. Press Shift and Enter for a new line."), true};
}

bool WordsControls::isEmpty() const { return m_words->words().isEmpty(); }

QWidget& WordsControls::firstFocus() { return *m_words; }

}  // namespace study::app
