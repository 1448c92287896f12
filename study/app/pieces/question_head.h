// Upper part of a question page: the presentation and the question to read aloud. Also the button for the first touch.
#pragma once

#include <QWidget>

#include "study/app/state/session_facts.h"
#include "study/session/driver.h"

class QLabel;
class QPushButton;

namespace study::app {

/// The instruction of the block: to read aloud where a block begins, else a reminder. Empty where the protocol gives none.
QString instructionToSay(const session::View& view);

/// A step of a break: the instruction to say before it ends.
QString instructionAfterBreak(const session::View& view);

class QuestionHead : public QWidget {
    Q_OBJECT
public:
    explicit QuestionHead(QWidget* parent);

    void present(const session::View& view);

private:
    QLabel* m_caption;
    QLabel* m_words;
    QLabel* m_instruction;  ///< of the block; hidden where the protocol gives none
};

/// Button that stamps the first touch and then shows who stamped it.
class TouchButton : public QWidget {
    Q_OBJECT
public:
    explicit TouchButton(QWidget* parent);

    void begin(const SessionFacts& facts)
    {
        m_displayReports = facts.displayReportsTouches;
        m_extraKey = facts.keys.extraKey(KeyAct::Touch);
    }
    void present(const session::View& view);

Q_SIGNALS:
    void touched();

private:
    QString textFor(const session::View& view) const;

    bool m_displayReports = false;
    std::optional<int> m_extraKey;
    QPushButton* m_button;
};

}  // namespace study::app
