// Footer of a session: the last answer, and buttons for the actions that are possible at any time.
#pragma once

#include <QFrame>
#include <vector>

#include "study/app/state/session_controller.h"

class QLabel;
class QPushButton;

namespace study::app {

class SessionFooter : public QFrame {
    Q_OBJECT
public:
    explicit SessionFooter(QWidget* parent);

    /// The buttons show these keys.
    void setKeys(const KeyBindings& keys);
    /// `canCorrect`: at least one answer can be corrected.
    void present(const session::View& view, bool canCorrect);
    bool canCorrect() const { return m_canCorrect; }
    /// Keys among the first `count` letters are answers or text on the page. They need Alt, and the buttons show this.
    void setLettersTaken(int count);
    /// Disables all buttons while a panel is open.
    void setPanelOpen(bool open);

    /// Presses the button of this key; returns false if there is none or it is disabled.
    bool pressKey(int key);

Q_SIGNALS:
    void correctionRequested();
    void noteRequested();
    void flagRequested();
    void voidRequested();
    void pauseRequested();
    void withdrawRequested();
    void leaveRequested();

protected:
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    struct Key {
        KeyAct act;
        int key = 0;
        QString name;  ///< "L"
        QPushButton* button = nullptr;
        QString text;  ///< text of the button without the key
    };
    QPushButton* add(const char* objectName, const QString& text, KeyAct act, int key, const QString& keyName);
    bool needsAlt(const Key& one, int lettersTaken) const { return one.key >= Qt::Key_A && one.key < Qt::Key_A + lettersTaken; }
    void showKeys();
    void enable();
    /// Leaves out the keys that are off, and the last answer, where the window is low.
    void arrange();

    std::vector<Key> m_keys;
    KeyBindings m_bindings;
    QLabel* m_lastAnswer;
    QPushButton* m_correct;
    QPushButton* m_note;
    QPushButton* m_flag;
    QPushButton* m_void;
    QPushButton* m_pause;
    QPushButton* m_leave;
    QPushButton* m_withdraw;
    bool m_canCorrect = false;
    bool m_canFlag = false;
    bool m_canVoid = false;
    bool m_isPaused = false;
    bool m_isOver = false;
    bool m_isPanelOpen = false;
    int m_lettersTaken = 0;
};

}  // namespace study::app
