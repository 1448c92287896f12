// Page of the latency task: the operator taps a key at each tone or flash for two minutes. The result is stored in the study.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "study/app/state/latency_task.h"
#include "study/session/clock.h"

class QLabel;
class QLineEdit;
class QPushButton;
class QTimer;

namespace study::app {

class MessageBar;

class LatencyPage : public QWidget {
    Q_OBJECT
public:
    LatencyPage(std::shared_ptr<session::Clock> clock, QWidget* parent);

    /// `operatorName`: proposed; the operator can change it.
    void present(const QString& operatorName);
    void showStored(const database::OperatorLatency& run);
    void showFault(const QString& text);
    void focusFirst();
    bool isRunning() const { return m_task.has_value(); }

Q_SIGNALS:
    /// The task came to its end.
    void measured(const database::OperatorLatency& run);
    void backRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    bool focusNextPrevChild(bool next) override;
    void hideEvent(QHideEvent* event) override;

private:
    void build();
    void start(const char* signal);
    void stop(const QString& why);
    void attend();
    void giveSignal();
    void takeSignalAway();
    void tap();
    void finish();

    std::shared_ptr<session::Clock> m_clock;
    std::optional<LatencyTask> m_task;
    std::string m_signal;  ///< "tone" or "flash"
    QLineEdit* m_operator;
    QPushButton* m_tone;
    QPushButton* m_flash;
    QPushButton* m_try;
    QPushButton* m_back;
    QLabel* m_lamp;
    QLabel* m_progress;
    MessageBar* m_message;
    QTimer* m_tick;
};

}  // namespace study::app
