// Runs work that may hang, such as a call of a server, on a thread that nobody waits for. The thread ends by itself, and its
// result is dropped when nobody is left to take it. Only the end of the program waits for it, a moment (haveLinksEnded()).
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>

namespace study::app {

class UnawaitedWork : public QObject {
public:
    /// Handles the result, on the window's thread.
    using Then = std::function<void()>;
    /// The work. It must hold what it needs: the window may be gone before it ends.
    using Work = std::function<Then()>;
    /// Handles an exception of the work, on the window's thread.
    using Failed = std::function<void(const QString& why)>;

    explicit UnawaitedWork(QObject* parent = nullptr) : QObject(parent) {}
    ~UnawaitedWork() override { giveUp(); }

    /// Gives up the current work, then starts the new one.
    void run(Work work, Failed failed);
    /// Drops the result of the current work.
    void giveUp();
    bool isBusy() const { return m_return != nullptr; }

private:
    struct Return;
    static void deliver(const std::shared_ptr<Return>& way, const Then& then);
    std::shared_ptr<Return> m_return;  ///< shared with the thread; null without work
};

}  // namespace study::app
