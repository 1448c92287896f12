// The line below every page of a session: the last answer read back, and what can be done at any time.
#pragma once

#include "study/app/session_controller.h"

#include <QFrame>

class QLabel;
class QPushButton;

namespace study::app {

class SessionFooter : public QFrame {
    Q_OBJECT
public:
    explicit SessionFooter(QWidget* parent);

    /// `canCorrect`: there is an answer that can be corrected.
    void present(const session::View& view, bool canCorrect);
    /// While a panel is open nothing else is begun.
    void setPanelOpen(bool open);

    /// The same buttons by key; true where there is one for it and it can be pressed now.
    bool pressKey(int key);

Q_SIGNALS:
    void correctionAsked();
    void noteAsked();
    void voidAsked();
    void pauseAsked();
    void withdrawAsked();
    void leaveAsked();

private:
    void enable();

    QLabel* m_lastAnswer;
    QPushButton* m_correct;
    QPushButton* m_note;
    QPushButton* m_void;
    QPushButton* m_pause;
    QPushButton* m_withdraw;
    QPushButton* m_leave;
    bool m_canCorrect = false;
    bool m_isTrialOn = false;
    bool m_isPaused = false;
    bool m_isOver = false;
    bool m_isPanelOpen = false;
};

}  // namespace study::app
