#include "study/participant/page/guarded_listener.h"

#include <unistd.h>

#include <QTimer>

namespace study::participant {

namespace {

constexpr int farewellMs = 500;

}  // namespace

GuardedSocket::GuardedSocket(const ConnectionLimits& limits, std::function<void()> gone, QObject* parent)
    : QTcpSocket(parent), m_gone(std::move(gone)), m_bytesLeft(limits.bytes)
{
    setReadBufferSize(2 * limits.bytes);  // what nobody reads yet must not fill the memory
    // Before the HTTP server's own connection, so that it never sees what is too much.
    connect(this, &QIODevice::readyRead, this, &GuardedSocket::count);
    // A browser that sends slowly must not hold the connection for ever.
    QTimer::singleShot(limits.lastsMs, this, &GuardedSocket::end);
}

GuardedSocket::~GuardedSocket() { m_gone(); }

bool GuardedSocket::takeFirstRequest()
{
    const bool isFirst = !m_isTaken && !m_isRefused;
    m_isTaken = true;
    return isFirst;
}

void GuardedSocket::count()
{
    // The HTTP server takes everything at each call, so these bytes are new.
    m_bytesLeft -= bytesAvailable();
    if (m_bytesLeft < 0) refuse();
}

void GuardedSocket::refuse()
{
    m_isRefused = true;
    QObject::disconnect(this, &QIODevice::readyRead, nullptr, nullptr);  // the HTTP server sees no more of it
    write("HTTP/1.1 413 Payload Too Large\r\nConnection: close\r\nCache-Control: no-store\r\nContent-Length: 0\r\n\r\n");
    disconnectFromHost();
    QTimer::singleShot(farewellMs, this, &GuardedSocket::end);
}

void GuardedSocket::end()
{
    abort();
    deleteLater();
}

void GuardedListener::incomingConnection(qintptr descriptor)
{
    if (*m_open >= m_limits.connections) {
        ::close(static_cast<int>(descriptor));
        return;
    }
    ++*m_open;
    auto* socket = new GuardedSocket(
        m_limits, [open = m_open] { --*open; }, this);
    if (socket->setSocketDescriptor(descriptor))
        addPendingConnection(socket);
    else
        delete socket;
}

}  // namespace study::participant
