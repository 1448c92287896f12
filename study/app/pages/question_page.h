// Page of one question about a presentation: the words to say, the entry of the answer with its read-back, and the button
// for the first touch. Enter stores the answer. Where the protocol requires second entries, the page asks twice and both
// entries must agree. The engine receives one answer.
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
    int lettersTaken() const override;
    bool hasUnstoredText() const override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;
    QWidget* lastOfAnswer() override;
    void discardEntry() override;

private:
    bool isSameQuestion(const session::View& view) const;
    void showReadBack();
    void markEntry();
    void markSpoken();
    void store();
    void takeEntry(const session::GivenAnswer& response);

    QuestionHead* m_head;
    AnswerEntry* m_entry;
    QLabel* m_readBack;
    TouchButton* m_touch;
    QPushButton* m_spoken;
    QPushButton* m_store;
    QLabel* m_next;
    QLabel* m_stroke;

    KeyBindings m_keys;
    QString m_same, m_different;  ///< as the participant says them
    bool m_wantsSecondEntry = false;
    std::optional<session::GivenAnswer> m_firstEntry;
    int m_entries = 0;  ///< of this answer, where it is entered twice
    std::optional<session::Presenting> m_shown;
    protocols::PresentationCode m_shownCode;
};

}  // namespace study::app
