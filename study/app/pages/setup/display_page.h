// Page of the haptic display: choose it, connect it, and feel a test pattern on it. The connection ends when the page is left,
// because a session opens its own.
#pragma once

#include <QWidget>

#include "study/app/state/tried_display.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace study::app {

class MessageBar;
class PatternButtons;

class DisplayPage : public QWidget {
    Q_OBJECT
public:
    /// Uses the display, settings and permissions of `options`.
    DisplayPage(const AppOptions& options, QWidget* parent);

    /// Shows the display that sessions use now. `why`: reason that the operator must choose one; empty if there is none.
    void present(const std::string& specification, const QString& why);
    void focusFirst();
    const TriedDisplay& tried() const { return *m_tried; }

Q_SIGNALS:
    /// This display was connected without a fault, or is "none".
    void chosen(const QString& specification);
    void rehearsalRequested();
    void backRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    void build();
    void chooseKind();
    void pressConnect();
    void connectDisplay();
    void stopConnecting();
    void useConnected();
    void showConnectFault(const QString& text);
    void showConnecting(bool isConnecting);
    void showPattern(const std::optional<TestPattern>& pattern);
    void readScale();
    void showState();
    void showFault(const QString& text);
    std::string specification() const;
    std::optional<double> scale() const;

    std::shared_ptr<QSettings> m_settings;
    TriedDisplay* m_tried;
    std::string m_connected;           ///< specification of the display that is connected, or being connected
    QWidget* m_focusBefore = nullptr;  ///< where the operator was before the display was being connected
    int m_touches = 0;
    QComboBox* m_kind;
    QLabel* m_caption;
    QLineEdit* m_argument;
    QPushButton* m_connect;
    QPushButton* m_rehearse;
    QPushButton* m_back;
    QLabel* m_state;
    QLabel* m_about;
    QLineEdit* m_scale;
    PatternButtons* m_patterns;
    QLabel* m_shown;
    MessageBar* m_message;
};

}  // namespace study::app
