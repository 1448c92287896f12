// Work on a thread of its own, so that the window stays alive; what it returns is done on the window's thread.
#pragma once

#include <QObject>
#include <atomic>
#include <functional>
#include <thread>

namespace study::app {

class InBackground : public QObject {
public:
    /// What is to be done with the result, on the window's thread.
    using Then = std::function<void()>;
    /// Must not throw; looks at `isStopping` now and then where it takes long.
    using Work = std::function<Then(const std::atomic<bool>& isStopping)>;

    explicit InBackground(QObject* parent) : QObject(parent) {}
    /// Asks the work to stop and waits for it; its result is dropped.
    ~InBackground() override { stop(); }

    /// Stops what is being done before.
    void run(Work work);
    void stop();
    bool isBusy() const { return m_isBusy; }

private:
    std::thread m_thread;
    std::atomic<bool> m_isStopping = false;
    bool m_isBusy = false;
    int m_run = 0;
};

}  // namespace study::app
