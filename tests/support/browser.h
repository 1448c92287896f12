// A browser without a screen: sends requests to the participant's page and keeps its cookie.
#pragma once

#include <QNetworkAccessManager>
#include <QNetworkReply>
#include <QTest>

namespace tests::support {

struct Answer {
    int status = 0;  ///< 0: no answer
    QByteArray body, cookie, type, policy;
};

class Browser {
public:
    /// `address`: "127.0.0.1:8577".
    explicit Browser(const QString& address) : m_address(address) {}

    QByteArray cookie;

    Answer get(const QString& path) { return answer(m_network.get(request(path))); }
    Answer post(const QString& path, const QByteArray& body) { return answer(m_network.post(request(path), body)); }
    Answer enter(const QByteArray& code)
    {
        const Answer entered = post("/enter", "{\"code\":\"" + code + "\"}");
        if (entered.status == 204) cookie = entered.cookie.left(entered.cookie.indexOf(';'));
        return entered;
    }

private:
    QNetworkRequest request(const QString& path) const
    {
        QNetworkRequest made(QUrl("http://" + m_address + path));
        made.setHeader(QNetworkRequest::ContentTypeHeader, "application/json");
        if (!cookie.isEmpty()) made.setRawHeader("Cookie", cookie);
        made.setAttribute(QNetworkRequest::CookieLoadControlAttribute, QNetworkRequest::Manual);
        made.setAttribute(QNetworkRequest::CookieSaveControlAttribute, QNetworkRequest::Manual);
        return made;
    }
    static Answer answer(QNetworkReply* reply)
    {
        if (!QTest::qWaitFor([reply] { return reply->isFinished(); }, 5000)) reply->abort();
        const Answer got{reply->attribute(QNetworkRequest::HttpStatusCodeAttribute).toInt(), reply->readAll(),
                         reply->rawHeader("Set-Cookie"), reply->rawHeader("Content-Type"),
                         reply->rawHeader("Content-Security-Policy")};
        reply->deleteLater();
        return got;
    }

    QString m_address;
    QNetworkAccessManager m_network;
};

}  // namespace tests::support
