// Page of the keys of a session: shows every act with its keys, and gives an act an extra key by pressing it.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "study/app/state/key_bindings.h"

class QPushButton;
class QSettings;
class QTreeWidget;

namespace study::app {

class MessageBar;

class KeysPage : public QWidget {
    Q_OBJECT
public:
    /// `settings` may be null; then the keys last until the window closes.
    KeysPage(std::shared_ptr<QSettings> settings, QWidget* parent);

    const KeyBindings& keys() const { return m_keys; }
    void present();
    void focusFirst();
    /// Shows the button of the latency task, which needs an open study.
    void offerLatencyTask(bool isOffered);
    /// The page waits for the new key.
    bool isWaiting() const { return m_waiting.has_value(); }

Q_SIGNALS:
    void backRequested();
    void latencyTaskRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    bool focusNextPrevChild(bool next) override;
    void hideEvent(QHideEvent* event) override;

private:
    void build();
    std::optional<KeyAct> chosenAct() const;
    void waitForKey();
    void take(int key);
    void removeKey();
    void resetAll();
    void showKeys();

    std::shared_ptr<QSettings> m_settings;
    KeyBindings m_keys;
    std::optional<KeyAct> m_waiting;
    QTreeWidget* m_acts;
    QPushButton* m_assign;
    QPushButton* m_remove;
    QPushButton* m_reset;
    QPushButton* m_latency;
    QPushButton* m_back;
    MessageBar* m_message;
};

}  // namespace study::app
