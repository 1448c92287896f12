// Header of a session: participant, the display and whether an image can be felt, phase, progress, time left, duration of this
// sitting, and next break.
#pragma once

#include <QFrame>

#include "study/app/state/session_controller.h"

class QLabel;
class QProgressBar;

namespace study::app {

class SessionHeader : public QFrame {
    Q_OBJECT
public:
    explicit SessionHeader(QWidget* parent);

    void begin(const SessionFacts& facts);
    void present(const session::View& view);

    /// Name of the test pattern that can be felt; empty if none.
    void setPattern(const QString& pattern) { m_pattern = pattern; }

protected:
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void showDisplay(const session::View& view);
    /// Leaves out the least important facts where the window is low.
    void arrange();
    std::vector<QLabel*> inOrderOfImportance() const;
    /// Width that shows at least whether an image can be felt, px.
    int shortestDisplay() const;

    int m_sittingMinutes = 60;
    bool m_isRehearsal = false;
    QString m_displayName, m_pattern;
    QString m_shortestDisplay;  ///< what the header says at least about the display
    QLabel* m_display;
    QLabel* m_participant;
    QLabel* m_part;
    QLabel* m_presentations;
    QLabel* m_answers;
    QLabel* m_timeLeft;
    QLabel* m_sitting;
    QLabel* m_nextBreak;
    QProgressBar* m_bar;
};

}  // namespace study::app
