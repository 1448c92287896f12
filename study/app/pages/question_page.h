// One question about a presentation: the words to say, the answer as it is entered and read back, the mark of the
// first touch. Enter stores. Where the protocol wants second entries, the answer is asked for twice and both must
// agree; the engine is told one answer.
#pragma once

#include <optional>

#include "study/app/pages/stage_page.h"

class QLabel;
class QPushButton;

namespace study::app {

class AnswerEntry;
class QuestionHead;
class TouchButton;

class QuestionPage : public StagePage {
    Q_OBJECT
public:
    explicit QuestionPage(QWidget* parent);

    void begin(const SessionFacts& facts) override;
    void present(const session::View& view) override;
    bool isForWriting() const override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

private:
    bool isSameQuestion(const session::View& view) const;
    void showReadBack();
    void store();
    void takeEntry(const session::GivenAnswer& response);

    QuestionHead* m_head;
    AnswerEntry* m_entry;
    QLabel* m_readBack;
    TouchButton* m_touch;
    QPushButton* m_store;
    QLabel* m_stroke;

    bool m_wantsSecondEntry = false;
    std::optional<session::GivenAnswer> m_firstEntry;
    std::optional<session::Presenting> m_shown;
    protocols::PresentationCode m_shownCode;
};

}  // namespace study::app
