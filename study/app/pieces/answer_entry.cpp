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

EntryControls& AnswerEntry::controlsFor(protocols::PhaseAnswer kind) const
{
    switch (kind) {
        case protocols::PhaseAnswer::Choice:
        case protocols::PhaseAnswer::SameDifferent:
            return *m_choice;
        case protocols::PhaseAnswer::Rating:
            return *m_rating;
        case protocols::PhaseAnswer::Words:
            return *m_words;
    }
    return *m_choice;
}

void AnswerEntry::ask(const AnswerForm& form)
{
    m_form = form;
    EntryControls& needed = controlsFor(form.kind);
    if (m_shown != &needed) m_shown->hide();
    m_shown = &needed;
    m_shown->show();
    m_shown->ask(form);
}

}  // namespace study::app
