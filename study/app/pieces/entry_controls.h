// Controls to enter one answer of one kind: a choice, a number on the scale, or words. They keep the entry and store nothing in
// the study.
#pragma once

#include <QWidget>
#include <variant>

#include "study/app/state/answer_form.h"

namespace study::app {

/// Sentence for the operator: the reason why no answer can be stored yet.
struct NoAnswer {
    QString why;
};

/// Text of the line below the controls.
struct ReadBack {
    QString text;             ///< words to say to the participant, or the next step
    bool isComplete = false;  ///< true if Enter can store the answer
};

class EntryControls : public QWidget {
    Q_OBJECT
public:
    using QWidget::QWidget;

    /// Clears the controls for an answer of this form, which must suit these controls.
    virtual void ask(const AnswerForm& form) = 0;
    /// The entered answer, or the reason why there is none yet.
    virtual std::variant<session::GivenAnswer, NoAnswer> give() = 0;
    virtual ReadBack readBack() const = 0;
    /// True while the operator has entered nothing.
    virtual bool isEmpty() const = 0;
    /// Handles a key that no control used; returns whether it chose an answer.
    virtual bool pressKey(int key) = 0;
    virtual QWidget& firstFocus() = 0;

Q_SIGNALS:
    void changed();
};

}  // namespace study::app
