// Controls to enter one answer of one kind: options to choose from, a number on the scale, words. They hold what is
// being entered and store nothing.
#pragma once

#include <QWidget>
#include <variant>

#include "study/app/state/answer_form.h"

namespace study::app {

/// Why nothing can be stored yet, as a sentence for the operator.
struct NoAnswer {
    QString why;
};

/// The line below the controls.
struct ReadBack {
    QString text;             ///< what to say to the participant, or what to do next
    bool isComplete = false;  ///< Enter can store it
};

class EntryControls : public QWidget {
    Q_OBJECT
public:
    using QWidget::QWidget;

    /// Blank, for an answer of this form, which must be the one that these controls are for.
    virtual void ask(const AnswerForm& form) = 0;
    /// What Enter gives: the answer, or what is still missing.
    virtual std::variant<session::GivenAnswer, NoAnswer> give() = 0;
    virtual ReadBack readBack() const = 0;
    /// A key that no control took; true where it chose something.
    virtual bool pressKey(int key) = 0;
    virtual QWidget& firstFocus() = 0;

Q_SIGNALS:
    void changed();
};

}  // namespace study::app
