// Controls to enter an answer of any kind. Shows the controls that the current form needs.
#pragma once

#include "study/app/pieces/entry_controls.h"

namespace study::app {

class AnswerEntry : public QWidget {
    Q_OBJECT
public:
    explicit AnswerEntry(QWidget* parent);

    /// Clears the entry and shows the controls for this form.
    void ask(const AnswerForm& form);
    const AnswerForm& form() const { return m_form; }

    std::variant<session::GivenAnswer, NoAnswer> give() { return m_shown->give(); }
    ReadBack readBack() const { return m_shown->readBack(); }
    bool isEmpty() const { return m_shown->isEmpty(); }
    bool pressKey(int key) { return m_shown->pressKey(key); }
    QWidget& firstFocus() { return m_shown->firstFocus(); }

Q_SIGNALS:
    void changed();

private:
    EntryControls& controlsFor(const AnswerForm& form) const;

    AnswerForm m_form;
    EntryControls* m_choice;
    EntryControls* m_rating;
    EntryControls* m_words;
    EntryControls* m_shown;
};

}  // namespace study::app
