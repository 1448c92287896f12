// Runs work on a worker thread, so that the window stays responsive. Its result or its fault arrives on the window's thread.
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <functional>
#include <thread>

namespace study::app {

/// What a page says where the system gives no further thread.
QString noThreadText();

class InBackground : public QObject {
public:
    /// Handles the result, on the window's thread.
    using Then = std::function<void()>;
    /// The work. Long work must check `isStopping` regularly and throw when it is true.
    using Work = std::function<Then(const std::atomic<bool>& isStopping)>;
    /// Handles an exception of the work, on the window's thread.
    using Failed = std::function<void(const QString& why)>;

    explicit InBackground(QObject* parent = nullptr) : QObject(parent) {}
    ~InBackground() override { stop(); }

    /// Stops the current work, then starts the new one. Where no thread can begin, `failed` gets that reason.
    void run(Work work, Failed failed);
    /// Asks the work to end early. Its result or fault still comes.
    void askToStop() { m_isStopping = true; }
    /// Asks the work to end early, waits for its end and drops its result.
    void stop();
    bool isBusy() const { return m_isBusy; }

private:
    void deliver(int run, const Then& then);

    std::thread m_thread;
    std::atomic<bool> m_isStopping = false;
    bool m_isBusy = false;
    int m_run = 0;  ///< results of earlier runs are dropped
};

}  // namespace study::app
