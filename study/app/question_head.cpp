#include "study/app/question_head.h"

#include "study/app/pieces.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

namespace study::app {

QuestionHead::QuestionHead(QWidget* parent)
    : QWidget(parent),
      m_caption(quietLabel("questionCaption", this)),
      m_words(label("questionWords", Type::Words, this, Weight::Bold)),
      m_way(quietLabel("strokeWords", this, Type::Plain))
{
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(m_caption);
    column->addWidget(m_words);
    column->addWidget(m_way);
    m_way->setText(tr("Same finger on glass and fabric, left to right, calmly and evenly."));
}

void QuestionHead::present(const session::View& view)
{
    const QString code = QString::fromStdString(view.code.value);
    const QString question = view.question ? QString::fromStdString(view.question->id.value) : QString();
    m_caption->setText(tr("Presentation %1    ·    %2    ·    say:").arg(code, question));
    m_words->setText(view.question ? tr("“%1”").arg(QString::fromStdString(view.question->text)) : QString());
}

TouchButton::TouchButton(QWidget* parent) : QWidget(parent), m_button(button("touchButton", tr("First touch (T)"), this))
{
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(m_button);
    connect(m_button, &QPushButton::clicked, this, &TouchButton::touched);
}

void TouchButton::present(const session::View& view)
{
    const auto* presenting = std::get_if<session::Presenting>(&view.state.stage);
    const bool isTouched = presenting && presenting->touchedAtNs.has_value();
    setButtonText(*m_button, isTouched ? tr("First touch is stamped ✓") : tr("First touch (T)"));
    m_button->setEnabled(presenting && !isTouched);
}

}  // namespace study::app
