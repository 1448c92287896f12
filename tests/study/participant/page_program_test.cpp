// The program vis2hap-page as the app and browsers use it: codes, a second tablet, a network that goes away, requests that are
// too large, malformed, too slow or too many.
#include <QElapsedTimer>
#include <QFile>
#include <QFileInfo>
#include <QProcess>
#include <QStandardPaths>
#include <QTcpSocket>
#include <QTest>
#include <csignal>

#include "study/participant/page_lines.h"
#include "tests/support/browser.h"

using namespace study::participant;
using tests::support::Answer;
using tests::support::Browser;

namespace {

const QString sources = QStringLiteral(VIS2HAP_SOURCE_DIR);

/// A file of the page.
QByteArray contentOf(const QString& name)
{
    QFile file(sources + "/study/participant/page/" + name);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// The program, its lines, and a browser.
struct RunningPage {
    QProcess process;
    LineBuffer buffer;
    std::vector<LineFromPage> lines;
    int port = 0;

    explicit RunningPage(const QStringList& arguments = {}, int wantedPort = 0)
    {
        process.start(QFileInfo(VIS2HAP_PROGRAM).path() + "/vis2hap-page",
                      QStringList{"--port", QString::number(wantedPort)} + arguments);
        QObject::connect(&process, &QProcess::readyReadStandardOutput, &process, [this] {
            for (const std::string& line : buffer.take(process.readAllStandardOutput().toStdString()))
                lines.push_back(lineFromPage(line));
        });
        if (!QTest::qWaitFor([this] { return !lines.empty(); }, 10000)) qFatal("vis2hap-page does not listen");
        port = std::get<Listening>(lines.front()).port;
        lines.clear();
    }
    ~RunningPage()
    {
        process.closeWriteChannel();
        process.waitForFinished(5000);
    }
    void send(const LineToPage& line) { process.write(QByteArray::fromStdString(lineOf(line) + "\n")); }
    void show(int number, const Instruction& instruction) { send(NumberedInstruction{number, instruction}); }
    QString address() const { return QString("127.0.0.1:%1").arg(port); }
    /// Waits for the next line for the app.
    LineFromPage nextLine()
    {
        if (!QTest::qWaitFor([this] { return !lines.empty(); }, 5000)) qFatal("no line came");
        const LineFromPage line = lines.front();
        lines.erase(lines.begin());
        return line;
    }
    /// Sends bytes as they are and returns everything until the connection ends.
    QByteArray raw(const QByteArray& bytes, int waitMs = 3000) const
    {
        QTcpSocket socket;
        socket.connectToHost("127.0.0.1", static_cast<quint16>(port));
        socket.waitForConnected(waitMs);
        socket.write(bytes);
        QByteArray all;
        while (socket.state() == QAbstractSocket::ConnectedState && socket.waitForReadyRead(waitMs)) all += socket.readAll();
        return all + socket.readAll();
    }
};

Instruction consent()
{
    Instruction instruction;
    instruction.task = Task::Consent;
    instruction.title = "Consent";
    instruction.statement = "I take part.";
    return instruction;
}

QByteArray requestText(const RunningPage& page, const QByteArray& firstLine, const QByteArray& more = {})
{
    return firstLine + "\r\nHost: " + page.address().toLatin1() + "\r\n" + more + "\r\n";
}

}  // namespace

class PageProgramTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aTabletEntersAndAgrees()
    {
        RunningPage page;
        page.send(NewCode{"482913"});
        page.show(1, consent());
        Browser tablet(page.address());
        const Answer html = tablet.get("/");
        QCOMPARE(html.status, 200);
        QVERIFY(html.type.startsWith("text/html") && html.body.contains("page.js") && html.policy.contains("default-src 'none'"));
        QVERIFY(tablet.get("/page.js").body.contains("/now"));
        QVERIFY(tablet.get("/page.css").type.startsWith("text/css"));
        QCOMPARE(tablet.get("/now").status, 401);
        QCOMPARE(tablet.enter("482913").status, 204);
        QVERIFY(std::holds_alternative<DeviceEntered>(page.nextLine()));
        QVERIFY(tablet.get("/now").body.contains("I take part."));
        QCOMPARE(tablet.post("/act", R"({"number":1,"agrees":true})").status, 204);
        QVERIFY(page.nextLine() == LineFromPage(ParticipantAct{1, Agreement{true}}));
    }

    /// Its script in a stub of a browser, where Node.js is there to run it.
    void thePageInABrowser_data()
    {
        QTest::addColumn<QString>("scenario");
        for (const char* scenario :
             {"aDisagreementIsThankedForOnlyAfterItWasSent", "aRefusedAnswerIsNamedAndStays", "aSecondTapDoesNotSendTheNextPage",
              "aSlowReplyHoldsOnlyItsOwnPage", "theLoginPageOfANetworkIsNoConnection",
              "aCodeThatTheLoginPageTookIsNotCalledWrong", "theWordsFollowTheStudy", "digitsOfOtherKeyboardsAreDigits",
              "aBrowserWithoutACallIsNamedTooOld", "aBrowserOf2018ShowsEveryPage"})
            QTest::newRow(scenario) << scenario;
    }
    void thePageInABrowser()
    {
        QFETCH(const QString, scenario);
        const QString node = QStandardPaths::findExecutable("node");
        if (node.isEmpty()) QSKIP("Node.js is not installed, so the script of the page was not run");
        QProcess process;
        process.start(node, {sources + "/tests/study/participant/page_in_node.js", sources, scenario});
        QVERIFY(process.waitForFinished(20000));
        QVERIFY2(process.exitCode() == 0, process.readAllStandardError().constData());
    }

    /// Old tablets show nothing of a script with a younger word, and touching buttons without their gaps.
    void thePageIsWrittenForBrowsersOf2018()
    {
        const QByteArray script = contentOf("page.js"), style = contentOf("page.css");
        QVERIFY(script.size() > 5000 && style.size() > 2000);
        for (const char* younger : {"replaceChildren", "replaceAll", "?.", "??", "{...", ", ...rest", "catch {", ".at(",
                                    "Object.fromEntries", "allSettled", "matchAll", "\\p{", "structuredClone"})
            QVERIFY2(!script.contains(younger), younger);
        for (const char* younger : {"inset:", "padding-block", "margin-inline", ":is(", ":where(", "aspect-ratio"})
            QVERIFY2(!style.contains(younger), younger);
        for (const QByteArray& line : style.split('\n'))
            QVERIFY2(!line.contains("gap:") || line.contains("grid"), line.constData());  // flex has no gap there
    }

    /// The line counts from the left, so its ends must not turn with an Arabic page.
    void theEndsOfTheLineKeepTheirSides()
    {
        const QByteArray style = contentOf("page.css");
        const auto rule = [&](const QByteArray& selector) {
            const auto at = style.indexOf("\n" + selector + " {");
            return at < 0 ? QByteArray() : style.mid(at, style.indexOf('}', at) - at);
        };
        QVERIFY(rule(".ends").contains("direction: ltr"));
        QVERIFY(rule(".ends span").contains("unicode-bidi: plaintext") && rule(".ends span").contains("text-align: left"));
        QVERIFY(rule(".ends span:last-child").contains("text-align: right"));
    }

    void wrongCodesWaitAndASecondTabletIsRefused()
    {
        RunningPage page({"--wait", "1"});
        page.send(NewCode{"482913"});
        Browser tablet(page.address()), second(page.address());
        for (int tries = 1; tries <= 4; ++tries) QCOMPARE(tablet.enter("000000").status, 403);
        QCOMPARE(tablet.enter("000000").status, 429);
        QCOMPARE(tablet.enter("482913").status, 429);
        for (int tries = 1; tries <= 5; ++tries)
            QVERIFY(page.nextLine() == LineFromPage(WrongCodeEntered{"127.0.0.1", tries, false}));
        QTest::qWait(1100);
        QCOMPARE(tablet.enter("482913").status, 204);
        const Answer refused = second.enter("482913");
        QCOMPARE(refused.status, 409);
        QVERIFY2(refused.body.contains("Another device shows this page."), refused.body.constData());
        QCOMPARE(second.get("/now").status, 401);
        page.send(NewCode{"111222"});
        QTRY_COMPARE(tablet.get("/now").status, 401);
        QCOMPARE(second.enter("111222").status, 204);
    }

    void aStartedAgainProgramKnowsTheTablet()
    {
        int port = 0;
        QByteArray cookie;
        std::string sessionHash;
        {
            RunningPage page;
            page.send(NewCode{"482913"});
            Browser tablet(page.address());
            tablet.enter("482913");
            sessionHash = std::get<DeviceEntered>(page.nextLine()).sessionHash;
            cookie = tablet.cookie;
            port = page.port;
            page.process.kill();
            page.process.waitForFinished(5000);
            QCOMPARE(tablet.get("/now").status, 0);
        }
        RunningPage again({}, port);
        QCOMPARE(again.port, port);
        again.send(KnownDevice{sessionHash});
        again.show(9, consent());
        Browser tablet(again.address());
        tablet.cookie = cookie;
        QTRY_COMPARE(tablet.get("/now").status, 200);
    }

    void requestsOfOtherNamesAndPlacesAreRefused_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QByteArray>("answer");
        const QByteArray host = "\r\nHost: HOST\r\n";
        QTest::newRow("the page") << "GET / HTTP/1.1" + host + "\r\n" << QByteArray("HTTP/1.1 200");
        QTest::newRow("a rebound name") << QByteArray("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n")
                                        << QByteArray("HTTP/1.1 421");
        QTest::newRow("no name") << QByteArray("GET / HTTP/1.1\r\n\r\n") << QByteArray("HTTP/1.1 421");
        QTest::newRow("a whole address of elsewhere") << "GET http://evil.example/study HTTP/1.1" + host + "\r\n"
                                                      << QByteArray("HTTP/1.1 404");
        QTest::newRow("an unknown path") << "GET /study.db HTTP/1.1" + host + "\r\n" << QByteArray("HTTP/1.1 404");
        QTest::newRow("a path above") << "GET /../../etc/passwd HTTP/1.1" + host + "\r\n" << QByteArray("HTTP/1.1 404");
        QTest::newRow("a doubled slash") << "GET //now HTTP/1.1" + host + "\r\n" << QByteArray("HTTP/1.1 404");
        QTest::newRow("a percent sign") << "GET /%6eow HTTP/1.1" + host + "\r\n" << QByteArray("HTTP/1.1 4");
        QTest::newRow("another method") << "PUT /now HTTP/1.1" + host + "Content-Length: 0\r\n\r\n" << QByteArray("HTTP/1.1 405");
        QTest::newRow("a question about methods") << "OPTIONS /act HTTP/1.1" + host + "\r\n" << QByteArray("HTTP/1.1 405");
        QTest::newRow("a form") << "POST /enter HTTP/1.1" + host + "Content-Type: text/plain\r\nContent-Length: 2\r\n\r\n{}"
                                << QByteArray("HTTP/1.1 415");
        QTest::newRow("no HTTP") << QByteArray("\x16\x03\x01 hello\r\n\r\n") << QByteArray();
        QTest::newRow("an unknown verb") << QByteArray("FEEL / HTTP/1.1\r\n\r\n") << QByteArray();
        QTest::newRow("a negative length") << "POST /enter HTTP/1.1" + host + "Content-Length: -5\r\n\r\n" << QByteArray();
        QTest::newRow("two lengths") << "POST /enter HTTP/1.1" + host + "Content-Length: 2\r\nContent-Length: 3\r\n\r\n{}"
                                     << QByteArray();
        QTest::newRow("a socket of the web") << "GET /now HTTP/1.1" + host +
                                                    "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Key: "
                                                    "AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n\r\n"
                                             << QByteArray();
    }
    void requestsOfOtherNamesAndPlacesAreRefused()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QByteArray, answer);
        RunningPage page({"--seconds", "2"});
        const QByteArray got = page.raw(bytes.replace("HOST", page.address().toLatin1()));
        QVERIFY2(answer.isEmpty() ? !got.startsWith("HTTP/1.1 2") : got.startsWith(answer), got.left(200).constData());
        QVERIFY(got.count("HTTP/1.1") <= 1);
        if (!answer.isEmpty()) QVERIFY(got.contains("no-store") && got.contains("frame-ancestors 'none'"));
        QCOMPARE(Browser(page.address()).get("/").status, 200);  // the page is still there
        QVERIFY(page.lines.empty());
    }

    void largeRequestsEndTheirConnection()
    {
        RunningPage page;
        QElapsedTimer time;
        time.start();
        const QByteArray header = page.raw(requestText(page, "GET / HTTP/1.1", "X-Long: " + QByteArray(200'000, 'a') + "\r\n"));
        QVERIFY2(header.isEmpty() || header.startsWith("HTTP/1.1 4"), header.left(100).constData());
        const QByteArray body =
            page.raw(requestText(page, "POST /enter HTTP/1.1", "Content-Type: application/json\r\nContent-Length: 9000000\r\n") +
                     QByteArray(9'000'000, 'a'));
        QVERIFY2(body.isEmpty() || body.startsWith("HTTP/1.1 4"), body.left(100).constData());
        const QByteArray chunks = page.raw(
            requestText(page, "POST /enter HTTP/1.1", "Content-Type: application/json\r\nTransfer-Encoding: chunked\r\n") +
            QByteArray("8000\r\n" + QByteArray(0x8000, 'a') + "\r\n").repeated(40));
        QVERIFY2(chunks.isEmpty() || chunks.startsWith("HTTP/1.1 4"), chunks.left(100).constData());
        const QByteArray inLimits =
            page.raw(requestText(page, "POST /enter HTTP/1.1", "Content-Type: application/json\r\nContent-Length: 70000\r\n") +
                     QByteArray(70'000, 'a'));
        QVERIFY2(inLimits.startsWith("HTTP/1.1 413"), inLimits.left(100).constData());
        for (int more = 0; more < 60; ++more)  // no connection stays behind
            page.raw(requestText(page, "GET / HTTP/1.1", "X-Long: " + QByteArray(200'000, 'a') + "\r\n"));
        QVERIFY2(time.elapsed() < 9000, "only the time limit ended a connection");
        QCOMPARE(Browser(page.address()).get("/").status, 200);
    }

    void oneConnectionServesOneRequest()
    {
        RunningPage page;
        const QByteArray twice = requestText(page, "GET /words HTTP/1.1") + requestText(page, "GET / HTTP/1.1");
        QCOMPARE(page.raw(twice).count("HTTP/1.1 200"), 1);
    }

    void slowAndManyConnectionsHoldNobodyUp()
    {
        RunningPage page({"--seconds", "1"});
        std::vector<std::unique_ptr<QTcpSocket>> held;
        for (int i = 0; i < 60; ++i) {
            held.push_back(std::make_unique<QTcpSocket>());
            held.back()->connectToHost("127.0.0.1", static_cast<quint16>(page.port));
            held.back()->waitForConnected(3000);
            held.back()->write("GET / HTTP/1.1\r\nHost: ");  // and never goes on
        }
        Browser tablet(page.address());
        QTRY_COMPARE_WITH_TIMEOUT(tablet.get("/").status, 200, 5000);
        const auto isOver = [](const auto& socket) { return socket->state() == QAbstractSocket::UnconnectedState; };
        QTRY_VERIFY_WITH_TIMEOUT(std::all_of(held.begin(), held.end(), isOver), 8000);
    }

    void theProgramHoldsNoFileAndNoSecret()
    {
        RunningPage page;
        const QString process = QString("/proc/%1/").arg(page.process.processId());
        for (const QFileInfo& descriptor :
             QDir(process + "fd").entryInfoList(QDir::System | QDir::Files | QDir::NoDotAndDotDot)) {
            const QString target = QFile::symLinkTarget(descriptor.filePath());
            QVERIFY2(!target.startsWith("/") || target.startsWith("/dev/") || target.contains("/fd/"), qPrintable(target));
        }
        QFile maps(process + "maps");
        QVERIFY(maps.open(QIODevice::ReadOnly));
        const QByteArray libraries = maps.readAll();
        QVERIFY(libraries.contains("libQt6HttpServer"));
        for (const char* library : {"libQt6Sql", "libQt6Widgets", "libsqlite", "libtorch", "libopencv"})
            QVERIFY2(!libraries.contains(library), library);
    }

    void theProgramEndsWithItsInputAndRefusesWrongCalls_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QByteArray>("input");
        QTest::addColumn<int>("exitCode");
        QTest::newRow("the input ends") << QStringList{"--port", "0"} << QByteArray() << 0;
        QTest::newRow("a line that the app never sends") << QStringList{"--port", "0"} << QByteArray("{\"hello\":1}\n") << 1;
        QTest::newRow("a line that never ends") << QStringList{"--port", "0"} << QByteArray(300'000, 'x') << 1;
        QTest::newRow("no address") << QStringList{"--address", "nowhere"} << QByteArray() << 2;
        QTest::newRow("an address of elsewhere") << QStringList{"--address", "203.0.113.7"} << QByteArray() << 3;
        QTest::newRow("no port") << QStringList{"--port", "70000"} << QByteArray() << 2;
        QTest::newRow("an unknown option") << QStringList{"--study", "x"} << QByteArray() << 1;
    }
    void theProgramEndsWithItsInputAndRefusesWrongCalls()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QByteArray, input);
        QProcess process;
        process.start(QFileInfo(VIS2HAP_PROGRAM).path() + "/vis2hap-page", arguments);
        QVERIFY(process.waitForStarted(5000));
        process.write(input);
        process.closeWriteChannel();
        QVERIFY(process.waitForFinished(10000));
        QTEST(process.exitCode(), "exitCode");
        const QByteArray said = process.readAllStandardError();
        QCOMPARE(said.isEmpty(), process.exitCode() == 0);
    }

    void theProgramDiesWithItsParent()
    {
        QProcess parent;
        parent.start("/bin/sh", {"-c", QFileInfo(VIS2HAP_PROGRAM).path() + "/vis2hap-page --port 0 <&0 & echo $!; sleep 30"});
        QVERIFY(parent.waitForReadyRead(5000));
        const int child = parent.readLine().trimmed().toInt();
        QVERIFY(child > 0 && ::kill(child, 0) == 0);
        parent.kill();
        parent.waitForFinished(5000);
        QTRY_VERIFY_WITH_TIMEOUT(::kill(child, 0) != 0 || !QFile::exists(QString("/proc/%1/exe").arg(child)) ||
                                     QFile::symLinkTarget(QString("/proc/%1/exe").arg(child)).isEmpty(),
                                 5000);
    }
};

QTEST_GUILESS_MAIN(PageProgramTest)
#include "page_program_test.moc"
