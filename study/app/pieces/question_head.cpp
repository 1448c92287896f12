#include "study/app/pieces/question_head.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "study/app/pieces/pieces.h"
#include "study/app/state/answer_form.h"

namespace study::app {

namespace {

QString instructionReminder(const session::View& view)
{
    if (!view.instruction) return {};
    return QuestionHead::tr("Instruction of this block: “%1”").arg(QString::fromStdString(view.instruction->text));
}

}  // namespace

QString instructionToSay(const session::View& view)
{
    if (!view.instruction || !view.instructionBegins) return instructionReminder(view);
    return QuestionHead::tr("Read this aloud now: “%1”").arg(QString::fromStdString(view.instruction->text));
}

QString instructionAfterBreak(const session::View& view)
{
    return QuestionHead::tr("Before you continue, say what the next block asks for: “%1”")
        .arg(QString::fromStdString(view.instruction->text));
}

QuestionHead::QuestionHead(QWidget* parent)
    : QWidget(parent),
      m_caption(quietLabel("questionCaption", this)),
      m_words(label("questionWords", Type::Words, this, Weight::Bold)),
      m_instruction(label("blockInstruction", Type::Body, this))
{
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(m_caption);
    column->addWidget(m_words);
    column->addWidget(m_instruction);
}

void QuestionHead::present(const session::View& view)
{
    const QString code = QString::fromStdString(view.code.value);
    const QString question = view.question ? QString::fromStdString(view.question->id.value) : QString();
    m_caption->setText(tr("Presentation %1    ·    %2    ·    say:").arg(code, question));
    m_words->setText(view.question ? tr("“%1”").arg(QString::fromStdString(view.question->text)) : QString());
    showText(*m_instruction, instructionReminder(view));
}

TouchButton::TouchButton(QWidget* parent)
    : QWidget(parent), m_button(button("touchButton", tr("Stamp the first touch (T)"), this))
{
    setRole(*m_button, "stamp");  // keeps the text readable when the button is disabled
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(m_button);
    connect(m_button, &QPushButton::clicked, this, &TouchButton::touched);
}

QString TouchButton::textFor(const session::View& view) const
{
    const auto& presenting = std::get<session::Presenting>(view.state.stage);
    const QString usual = std::holds_alternative<WordsForm>(formOf(view)) ? tr("Alt T") : tr("T");
    const QString key = m_extraKey ? tr("%1 or %2").arg(usual, nameOfKey(*m_extraKey)) : usual;
    if (!presenting.touchedAtNs)
        return m_displayReports ? tr("The display reports the first touch (or press %1)").arg(key)
                                : tr("Stamp the first touch (%1)").arg(key);
    return presenting.touchedBy == session::TouchSource::Display ? tr("The display reported the first touch ✓")
                                                                 : tr("You stamped the first touch ✓");
}

void TouchButton::present(const session::View& view)
{
    setButtonText(*m_button, textFor(view));
    m_button->setEnabled(!std::get<session::Presenting>(view.state.stage).touchedAtNs);
}

}  // namespace study::app
