// Corrects a stored answer, in place of the stage page: which one (the last at first), what it is now, what it
// shall be, and why. The old value stays in the record.
#pragma once

#include "study/app/stage_page.h"

class QHBoxLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QVBoxLayout;

namespace study::app {

class RatingField;

class CorrectionPanel : public StagePage {
    Q_OBJECT
public:
    explicit CorrectionPanel(QWidget* parent);

    /// `answers`: the last one first; at least one.
    void ask(const std::vector<Correctable>& answers);

    void present(const session::View&) override {}
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

Q_SIGNALS:
    void closeAsked();

private:
    void showQuestions();
    void showAnswer(std::size_t place);
    void showChoices(const Correctable& answer);
    void choose(std::size_t place);
    void confirm();
    /// Empty where none is given yet; the reason is told then.
    std::optional<session::Response> newResponse();
    const Correctable& chosenAnswer() const;

    std::vector<Correctable> m_correctables;
    std::size_t m_which = 0;  ///< of the correctables
    QHBoxLayout* m_questionsRow;
    std::vector<QPushButton*> m_questions;
    QLabel* m_old;
    RatingField* m_rating;
    QVBoxLayout* m_choicesColumn;
    std::vector<QPushButton*> m_choices;
    std::optional<std::size_t> m_chosen;
    bool m_isReasonAskedAgain = false;
    QLineEdit* m_why;
    QPushButton* m_action;
    QPushButton* m_back;
};

}  // namespace study::app
