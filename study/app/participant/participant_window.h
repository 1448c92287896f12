// The second screen: a plain window that shows the participant's instruction. It takes no keys, so the console keeps them.
#pragma once

#include <QWidget>

class QScreen;

namespace study::app {

class ParticipantSide;

class ParticipantWindow : public QWidget {
    Q_OBJECT
public:
    /// Fills `screen`; on the console's own screen it is an ordinary window.
    ParticipantWindow(const ParticipantSide& side, QScreen& screen, const QScreen& console);

Q_SIGNALS:
    /// The window was closed, or its screen was disconnected.
    void closed();

protected:
    void closeEvent(QCloseEvent* event) override;
};

}  // namespace study::app
