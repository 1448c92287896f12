// Form to correct a stored answer: the question (at first the last one answered), the stored answer, the new answer and the
// reason. The study keeps the old answer.
#pragma once

#include "study/app/pages/form_panel.h"
#include "study/app/state/session_controller.h"

class QLabel;
class QPushButton;

namespace study::app {

class AnswerEntry;
class FlowLayout;

class CorrectionPanel : public FormPanel {
    Q_OBJECT
public:
    explicit CorrectionPanel(QWidget* parent);

    /// Opens the form. `answers`: at least one, the latest first.
    void ask(const std::vector<Correctable>& answers);

    bool pressKey(int key) override;
    QWidget& firstFocus() override;
    void discardEntry() override;
    bool hasUnstoredText() const override;

protected:
    bool isReady() override;
    session::EventBody eventFor(const std::string& reason) override;

private:
    void showQuestions();
    void showAnswer(std::size_t place);

    std::vector<Correctable> m_correctables;
    std::size_t m_which = 0;  ///< index in m_correctables
    std::optional<session::GivenAnswer> m_response;
    FlowLayout* m_questionsRow;
    std::vector<QPushButton*> m_questions;
    QLabel* m_old;
    AnswerEntry* m_entry;
};

}  // namespace study::app
