// Serves the participant's page over HTTP: gives each request to PageRoom as a value and writes its reply. Qt's HTTP server reads
// the requests (a technical preview in Qt 6.4, so only vis2hap-page links it).
#pragma once

#include <QAbstractHttpServer>
#include <QElapsedTimer>
#include <functional>

#include "study/participant/page/guarded_listener.h"
#include "study/participant/page_room.h"

namespace study::participant {

class PageServer final : public QAbstractHttpServer {
    Q_OBJECT
public:
    /// Listens at `address`, at `port` if it is free and otherwise at any port. `tell`: takes each line for the app. Throws
    /// environmentFault where it cannot listen.
    PageServer(const QHostAddress& address, quint16 port, const AccessLimits& limits, const ConnectionLimits& connections,
               std::function<void(const LineFromPage&)> tell);

    quint16 port() const { return m_listener->serverPort(); }
    void take(const LineToPage& line) { m_room->take(line, m_clock.nsecsElapsed()); }

protected:
    bool handleRequest(const QHttpServerRequest& request, QTcpSocket* socket) override;
    void missingHandler(const QHttpServerRequest& request, QTcpSocket* socket) override;

private:
    GuardedListener* m_listener;
    std::unique_ptr<PageRoom> m_room;
    std::function<void(const LineFromPage&)> m_tell;
    QElapsedTimer m_clock;
};

}  // namespace study::participant
