// Corrects a stored answer: which one (the last at first), what it is now, what it shall be, and why. The old value
// stays in the record.
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

    /// `answers`: the last one first; at least one.
    void ask(const std::vector<Correctable>& answers);

    bool pressKey(int key) override;
    QWidget& firstFocus() override;

protected:
    bool isReady() override;
    session::EventBody eventFor(const std::string& reason) override;

private:
    void showQuestions();
    void showAnswer(std::size_t place);

    std::vector<Correctable> m_correctables;
    std::size_t m_which = 0;  ///< of the correctables
    std::optional<session::Response> m_response;
    FlowLayout* m_questionsRow;
    std::vector<QPushButton*> m_questions;
    QLabel* m_old;
    AnswerEntry* m_entry;
};

}  // namespace study::app
