// Accepts connections of browsers within limits: how many at a time, how long each lasts, and how many bytes it may send. Qt's
// HTTP server (6.4) limits none of them, and it forgets a connection that sends no HTTP without closing it.
#pragma once

#include <QTcpServer>
#include <QTcpSocket>
#include <functional>
#include <memory>

namespace study::participant {

struct ConnectionLimits {
    int connections = 24;
    int lastsMs = 10'000;
    qint64 bytes = 96 * 1024;  ///< of one request with its headers
};

/// One connection serves one request.
class GuardedSocket final : public QTcpSocket {
    Q_OBJECT
public:
    /// `gone`: called by the destructor.
    GuardedSocket(const ConnectionLimits& limits, std::function<void()> gone, QObject* parent);
    ~GuardedSocket() override;

    /// False at the second call: a browser that sends another request on this connection gets no answer.
    bool takeFirstRequest();

private:
    void count();
    void refuse();
    void end();

    std::function<void()> m_gone;
    qint64 m_bytesLeft;
    bool m_isRefused = false;
    bool m_isTaken = false;
};

class GuardedListener final : public QTcpServer {
    Q_OBJECT
public:
    explicit GuardedListener(const ConnectionLimits& limits) : m_limits(limits) {}

protected:
    void incomingConnection(qintptr descriptor) override;

private:
    ConnectionLimits m_limits;
    std::shared_ptr<int> m_open = std::make_shared<int>(0);
};

}  // namespace study::participant
