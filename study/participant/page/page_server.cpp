#include "study/participant/page/page_server.h"

#include <QFile>
#include <QHttpServerRequest>
#include <QHttpServerResponder>
#include <QMetaEnum>
#include <QRandomGenerator>
#include <array>

#include "protocols/files/errors.h"

namespace study::participant {

namespace {

std::string builtIn(const char* name)
{
    QFile file(QStringLiteral(":/page/") + QLatin1String(name));
    return file.open(QIODevice::ReadOnly) ? file.readAll().toStdString() : std::string();
}

/// 256 bits of the system's generator, in hexadecimal.
std::string drawnSecret()
{
    std::array<quint32, 8> words{};
    QRandomGenerator::system()->fillRange(words.data(), static_cast<qsizetype>(words.size()));
    return QByteArray(reinterpret_cast<const char*>(words.data()), sizeof words).toHex().toStdString();
}

std::string hostOf(const QHostAddress& address, quint16 port)
{
    const QString text = address.toString().section(QLatin1Char('%'), 0, 0);
    const bool isVersion6 = address.protocol() == QAbstractSocket::IPv6Protocol;
    return ((isVersion6 ? QLatin1Char('[') + text + QLatin1Char(']') : text) + QLatin1Char(':') + QString::number(port))
        .toStdString();
}

std::string methodOf(const QHttpServerRequest& request)
{
    return QByteArray(QMetaEnum::fromType<QHttpServerRequest::Method>().valueToKey(static_cast<int>(request.method())))
        .toUpper()
        .toStdString();
}

PageRequest valueOf(const QHttpServerRequest& request)
{
    const auto header = [&](const char* name) { return request.value(name).toStdString(); };
    return {.method = methodOf(request),
            .path = request.url().toString(QUrl::RemoveScheme | QUrl::RemoveAuthority | QUrl::FullyEncoded).toStdString(),
            .host = header("Host"),
            .origin = header("Origin"),
            .cookie = header("Cookie"),
            .contentType = header("Content-Type"),
            .body = request.body().toStdString(),
            .from = request.remoteAddress().toString().toStdString()};
}

}  // namespace

PageServer::PageServer(const QHostAddress& address, quint16 port, const AccessLimits& limits, const ConnectionLimits& connections,
                       std::function<void(const LineFromPage&)> tell)
    : m_listener(new GuardedListener(connections)), m_tell(std::move(tell))
{
    m_clock.start();
    m_listener->setParent(this);
    if (!m_listener->listen(address, port) && !m_listener->listen(address, 0))
        throw protocols::environmentFault({"the participant's page cannot listen: " + m_listener->errorString().toStdString(),
                                           address.toString().toStdString(), "an address of this computer",
                                           "choose another network on the page \"Participant's screen\""});
    m_room = std::make_unique<PageRoom>(hostOf(address, m_listener->serverPort()),
                                        PageFiles{builtIn("page.html"), builtIn("page.css"), builtIn("page.js")},
                                        PageAccess(drawnSecret, limits));
    bind(m_listener);
}

bool PageServer::handleRequest(const QHttpServerRequest& request, QTcpSocket* socket)
{
    auto* guarded = qobject_cast<GuardedSocket*>(socket);
    if (!guarded || !guarded->takeFirstRequest()) return true;
    const PageReply reply = m_room->answer(valueOf(request), m_clock.nsecsElapsed());
    {
        QHttpServerResponder responder = makeResponder(request, socket);
        responder.writeStatusLine(static_cast<QHttpServerResponder::StatusCode>(reply.status));
        responder.writeHeader("Connection", "close");
        if (!reply.contentType.empty()) responder.writeHeader("Content-Type", QByteArray::fromStdString(reply.contentType));
        for (const auto& [name, value] : reply.headers)
            responder.writeHeader(QByteArray::fromStdString(name), QByteArray::fromStdString(value));
        responder.writeHeader("Content-Length", QByteArray::number(static_cast<qulonglong>(reply.body.size())));
        responder.writeBody(QByteArray::fromStdString(reply.body));
    }
    socket->disconnectFromHost();
    for (const LineFromPage& line : reply.lines) m_tell(line);
    return true;
}

void PageServer::missingHandler(const QHttpServerRequest&, QTcpSocket* socket) { socket->disconnectFromHost(); }

}  // namespace study::participant
