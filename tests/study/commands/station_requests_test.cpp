// The relay of a display reads what any program of the computer may send, in whatever parts it comes.
#include "study/commands/server/station_requests.h"

#include <QTest>
#include <string>
#include <vector>

using study::commands::StationRequest;
using study::commands::StationRequests;
using Kind = StationRequest::Kind;

namespace {

std::vector<StationRequest> requestsIn(const std::string& bytes, std::size_t part)
{
    StationRequests requests;
    std::vector<StationRequest> all;
    for (std::size_t from = 0; from < bytes.size(); from += part) {
        requests.add(std::string_view(bytes).substr(from, part));
        while (auto request = requests.next()) all.push_back(std::move(*request));
    }
    return all;
}

std::vector<StationRequest> requestsIn(const std::string& bytes) { return requestsIn(bytes, bytes.size()); }

std::string showOf(const char* bytes) { return std::string(R"({"type":"show","id":7,"bytes":)") + bytes + "}\n"; }

}  // namespace

class StationRequestsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aSessionIsReadInAnyParts_data()
    {
        QTest::addColumn<int>("part");
        for (const int part : {1, 2, 3, 5, 64, 4096, 100000}) QTest::addRow("%d bytes", part) << part;
    }
    void aSessionIsReadInAnyParts()
    {
        QFETCH(const int, part);
        const std::string hello = "{\"type\":\"hello\",\"id\":1}\r\n", clear = "{\"id\":9,\"type\":\"clear\"}\n";
        const std::string ticket = "{\"type\":\"hello\"}\n\n";  // a ticket that looks like a line is still a ticket
        const auto all =
            requestsIn(hello + showOf("18") + ticket + showOf("0") + showOf("1025") + std::string(1025, '\n') + clear,
                       static_cast<std::size_t>(part));
        QCOMPARE(all.size(), std::size_t{5});
        QVERIFY(all[0].kind == Kind::Passed && all[0].isHello && all[0].id == 1 && all[0].line == hello);
        QVERIFY(all[1].kind == Kind::Ticket && all[1].id == 7 && all[1].ticket == ticket);
        QVERIFY(all[2].kind == Kind::Ticket && all[2].ticket.empty());
        QVERIFY(all[3].kind == Kind::Image && all[3].id == 7 && all[3].ticket.empty());
        QVERIFY(all[4].kind == Kind::Passed && all[4].isClear && all[4].id == 9 && all[4].line == clear);
    }

    void aTicketIsAwaitedToItsLastByte()
    {
        StationRequests requests;
        requests.add(showOf("3") + "ab");
        QVERIFY(!requests.next());
        requests.add("c{");
        QCOMPARE(QString::fromStdString(requests.next().value().ticket), QString("abc"));
        QVERIFY(!requests.next());
    }

    void whatNobodyCanReadEndsTheRequests_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<int>("kind");
        const auto row = [](const char* name, const std::string& bytes, Kind kind) {
            QTest::newRow(name) << QByteArray::fromStdString(bytes) << static_cast<int>(kind);
        };
        row("no JSON", "GET / HTTP/1.1\r\n", Kind::NoMessage);
        row("empty line", "\n", Kind::NoMessage);
        row("list", "[1]\n", Kind::NoMessage);
        row("no type", "{\"id\":1}\n", Kind::NoMessage);
        row("twice a key", "{\"type\":\"hello\",\"id\":1,\"id\":2}\n", Kind::NoMessage);
        row("deep", "{\"type\":" + std::string(50000, '[') + "\n", Kind::NoMessage);
        row("no UTF-8", "{\"type\":\"\xff\"}\n", Kind::NoMessage);
        row("no count", "{\"type\":\"show\",\"id\":1}\n", Kind::NoTicket);
        row("negative count", showOf("-1"), Kind::NoTicket);
        row("count with a fraction", showOf("8.5"), Kind::NoTicket);
        row("largest count and one", showOf("67108865"), Kind::NoTicket);
        row("count of 64 bits", showOf("18446744073709551615"), Kind::NoTicket);
        row("no id", "{\"type\":\"show\",\"bytes\":1}\n", Kind::NoTicket);
        row("id of 64 bits", "{\"type\":\"show\",\"id\":9223372036854775808,\"bytes\":1}\n", Kind::NoTicket);
        row("long line", std::string(StationRequests::longestLine + 1, ' ') + "\n", Kind::TooLong);
    }
    void whatNobodyCanReadEndsTheRequests()
    {
        QFETCH(const QByteArray, bytes);
        QFETCH(const int, kind);
        const std::string more = "{\"type\":\"hello\",\"id\":1}\n";
        for (const std::size_t part : {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 20}) {
            const auto all = requestsIn(bytes.toStdString() + more, part);
            QCOMPARE(all.size(), std::size_t{1});
            QCOMPARE(static_cast<int>(all.front().kind), kind);
        }
    }

    void theLongestLineAndTheLargestImageAreTaken()
    {
        std::string line = "{\"type\":\"status\",\"id\":3}";
        line += std::string(StationRequests::longestLine - line.size(), ' ') + "\n";
        const auto all = requestsIn(line + showOf("67108864") + "the image");
        QCOMPARE(all.size(), std::size_t{2});
        QVERIFY(all[0].kind == Kind::Passed && all[0].id == 3 && all[0].line == line);
        QVERIFY(all[1].kind == Kind::Image);
    }

    /// A number that does not fit is no id; the device then answers by itself.
    void otherRequestsPassWithoutAnId()
    {
        const auto all = requestsIn("{\"type\":\"hello\",\"id\":9223372036854775808}\n{\"type\":4,\"id\":\"a\"}\n");
        QCOMPARE(all.size(), std::size_t{2});
        QVERIFY(all[0].kind == Kind::Passed && all[0].isHello && !all[0].id);
        QVERIFY(all[1].kind == Kind::Passed && !all[1].isHello && !all[1].isClear && !all[1].id);
    }
};

QTEST_GUILESS_MAIN(StationRequestsTest)
#include "station_requests_test.moc"
