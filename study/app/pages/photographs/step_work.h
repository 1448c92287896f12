// Runs one step of a page at a time on a worker thread. Progress and faults appear in the message beside the step; Esc stops it.
#pragma once

#include <QObject>
#include <functional>
#include <stdexcept>

#include "study/app/state/in_background.h"
#include "study/app/state/photograph_steps.h"

class QWidget;

namespace study::app {

class MessageBar;

/// A stop that the operator asked for.
struct StepStopped : std::runtime_error {
    StepStopped();
};

class StepWork : public QObject {
    Q_OBJECT
public:
    /// `page` keeps the focus while a step runs, so that it does not scroll away.
    explicit StepWork(QWidget& page) : m_page(page) {}

    using Step = std::function<InBackground::Then(const ToolProgress& progress)>;
    /// Runs a step, unless one is running.
    void run(MessageBar& message, const QString& doing, Step step);
    bool isBusy() const { return m_work.isBusy(); }
    void askToStop() { m_work.askToStop(); }
    void stop() { m_work.stop(); }

Q_SIGNALS:
    /// A step began or ended.
    void busyChanged();

private:
    QWidget& m_page;
    InBackground m_work;
};

}  // namespace study::app
