// Controls for an answer in the participant's own words. A second Enter stores an answer without words.
#pragma once

#include "study/app/pieces/entry_controls.h"

namespace study::app {

class WordsField;

class WordsControls : public EntryControls {
    Q_OBJECT
public:
    explicit WordsControls(QWidget* parent);

    void ask(const AnswerForm& form) override;
    std::variant<session::GivenAnswer, NoAnswer> give() override;
    ReadBack readBack() const override;
    bool isEmpty() const override;
    bool pressKey(int) override { return false; }
    QWidget& firstFocus() override;

private:
    WordsField* m_words;
    bool m_isAskedAgain = false;  ///< true after the hint about missing words
};

}  // namespace study::app
