#include "study/app/pieces/answer_entry.h"

#include <QVBoxLayout>

#include "study/app/pieces/choice_controls.h"
#include "study/app/pieces/rating_controls.h"
#include "study/app/pieces/words_controls.h"

namespace study::app {

AnswerEntry::AnswerEntry(QWidget* parent)
    : QWidget(parent),
      m_choice(new ChoiceControls(this)),
      m_rating(new RatingControls(this)),
      m_words(new WordsControls(this)),
      m_shown(m_choice)
{
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    for (EntryControls* controls : {m_choice, m_rating, m_words}) {
        column->addWidget(controls);
        controls->hide();
        connect(controls, &EntryControls::changed, this, &AnswerEntry::changed);
    }
}

EntryControls& AnswerEntry::controlsFor(const AnswerForm& form) const
{
    EntryControls* controls = std::visit(
        protocols::Overloaded{[this](const OptionsForm&) { return m_choice; }, [this](const ScaleForm&) { return m_rating; },
                              [this](const WordsForm&) { return m_words; }},
        form);
    return *controls;
}

void AnswerEntry::ask(const AnswerForm& form)
{
    m_form = form;
    EntryControls& needed = controlsFor(form);
    if (m_shown != &needed) m_shown->hide();
    m_shown = &needed;
    m_shown->show();
    m_shown->ask(form);
}

}  // namespace study::app
