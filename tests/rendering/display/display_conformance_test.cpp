// The check that the owner of a display runs: the reference driver meets every requirement, and each deliberately broken
// driver is recognised by name.
#include <QCoreApplication>
#include <QDir>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <opencv2/core.hpp>

#include "rendering/display/display_check.h"
#include "rendering/images/image_io.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using namespace std::chrono_literals;

namespace {

std::string reference() { return VIS2HAP_REFERENCE_DISPLAY; }

/// Short times, because some faults are time-outs.
DisplayCheckOptions impatient()
{
    DisplayCheckOptions options;
    options.patience = {.reply = 300ms, .start = 600ms, .tries = 1};
    return options;
}

QString faultsOf(const DisplayCheck& check)
{
    QStringList faults;
    for (const auto& demand : check.demands)
        if (!demand.fault.empty()) faults << QString::fromStdString(demand.demand + ": " + demand.fault);
    return faults.join("\n");
}

DisplayCheck checked(const std::string& specification, const DisplayCheckOptions& options)
{
    return checkDisplay(driverAddressFrom(specification).value(), options);
}

/// The next line of a program; empty where none comes in time.
QByteArray lineOf(QProcess& program)
{
    while (!program.canReadLine())
        if (!program.waitForReadyRead(5000)) return {};
    return program.readLine();
}

/// The reference driver behind a port that the system chooses.
class Listening {
public:
    explicit Listening(const QStringList& arguments, const QString& place = "0")
    {
        m_process.start(QString::fromStdString(reference()), arguments + QStringList{"--listen", place});
        while (m_process.state() != QProcess::NotRunning && !m_process.canReadLine()) m_process.waitForReadyRead(1000);
        const auto told = QRegularExpression("port (\\d+)").match(QString::fromUtf8(m_process.readLine()));
        specification = "tcp:127.0.0.1:" + told.captured(1).toStdString();
    }
    ~Listening()
    {
        m_process.kill();
        m_process.waitForFinished();
    }
    std::string specification;

private:
    QProcess m_process;
};

}  // namespace

class DisplayConformanceTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_folder;

private Q_SLOTS:
    void referenceDriverMeetsEveryDemand_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::newRow("plain") << QStringList{};
        QTest::newRow("slow") << QStringList{"--delay", "20"};
        QTest::newRow("touched") << QStringList{"--touch-after", "30"};
        // Each touch is reported while the next request is on its way.
        QTest::newRow("touched at once") << QStringList{"--touch-after", "0"};
    }
    void referenceDriverMeetsEveryDemand()
    {
        QFETCH(QStringList, arguments);
        const QString folder = m_folder.filePath(QTest::currentDataTag());
        DisplayCheckOptions options;
        options.touchWithin = arguments.contains("--touch-after") ? 2s : 0s;
        const auto check =
            checked("exec:" + reference() + " '" + folder.toStdString() + "' " + arguments.join(" ").toStdString(), options);
        QVERIFY2(check.faults() == 0, qPrintable(faultsOf(check)));
        QCOMPARE(check.demands.size(), std::size_t(arguments.contains("--touch-after") ? 19 : 18));
        QCOMPARE(check.name, std::string("reference display"));
        QCOMPARE(check.showMs.size(), std::size_t(10));
        if (arguments.contains("--delay")) QVERIFY(*std::min_element(check.showMs.begin(), check.showMs.end()) >= 20);
        // After its end of file nothing can be felt.
        QCOMPARE(cv::countNonZero(readPgm((folder + "/current.pgm").toStdString())), 0);
    }

    void referenceDriverMeetsEveryDemandOverTheNetwork()
    {
        const Listening driver({m_folder.filePath("tcp")});
        const auto check = checked(driver.specification, {});
        QVERIFY2(check.faults() == 0, qPrintable(faultsOf(check)));
    }

    void referenceDriverWithAPortAloneServesItsOwnComputerOnly()
    {
        const auto at = [](const Listening& driver, const std::string& host) {
            return "tcp:" + host + driver.specification.substr(driver.specification.rfind(':'));
        };
        const Listening alone({m_folder.filePath("alone")});
        QVERIFY(checked(at(alone, "127.0.0.2"), impatient()).demands.front().fault.find("cannot be reached") !=
                std::string::npos);
        const Listening everywhere({m_folder.filePath("everywhere")}, "0.0.0.0:0");
        QCOMPARE(checked(at(everywhere, "127.0.0.2"), {}).faults(), 0);
    }

    void hostileRequestsGetAReply_data()
    {
        QTest::addColumn<QByteArray>("request");
        QTest::newRow("width is a word") << QByteArray(R"({"type":"show","id":2,"width":"x","height":1,"bytes":1})"
                                                       "\nZ");
        QTest::newRow("size is negative") << QByteArray(R"({"type":"show","id":2,"width":-1,"height":-1,"bytes":1})"
                                                        "\nZ");
        QTest::newRow("no JSON") << QByteArray("show me\n");
        QTest::newRow("no object") << QByteArray("[1,2]\n");
        QTest::newRow("not UTF-8") << QByteArray("{\"type\":\"\xff\",\"id\":2}\n");
        QTest::newRow("nested deeply") << R"({"type":"clear","id":)" + QByteArray(30000, '[') + QByteArray(30000, ']') + "}\n";
    }
    void hostileRequestsGetAReply()
    {
        QFETCH(QByteArray, request);
        QProcess driver;
        driver.start(QString::fromStdString(reference()), {m_folder.filePath("hostile")});
        driver.write(request + R"({"type":"status","id":3})" + "\n");
        const QByteArray reply = lineOf(driver), after = lineOf(driver);
        QVERIFY2(reply.contains(R"("type":"failed")"), reply.constData());
        QVERIFY2(after.contains(R"("type":"status","id":3)"), after.constData());
        driver.closeWriteChannel();
        QVERIFY(driver.waitForFinished());
        QCOMPARE(driver.exitStatus(), QProcess::NormalExit);
    }

    void aLineWithoutAnEndEndsTheConnection()
    {
        QProcess driver;
        driver.start(QString::fromStdString(reference()), {m_folder.filePath("endless")});
        driver.write(QByteArray(70000, 'x'));
        const QByteArray reply = lineOf(driver);
        QVERIFY2(reply.contains("longer than 65536 bytes"), reply.constData());
        QVERIFY(driver.waitForFinished());  // although the input is still open
        QCOMPARE(driver.exitStatus(), QProcess::NormalExit);
    }

    void aDeviceThatTakesNoImageIsNotShown()
    {
        const QString folder = m_folder.filePath("gone");
        QProcess driver;
        driver.start(QString::fromStdString(reference()), {folder});
        driver.write(R"({"type":"hello","id":1})"
                     "\n");
        QVERIFY(lineOf(driver).contains("hello"));
        const auto isRefused = [&] {
            driver.write(R"({"type":"show","id":2,"width":1,"height":1,"bytes":1})"
                         "\nZ");
            return lineOf(driver).contains(R"("type":"failed","id":2)");
        };
        QVERIFY(QFile::link("/dev/full", folder + "/next.pgm.part"));  // the disk is full
        QVERIFY(isRefused());
        QVERIFY(QDir(folder).removeRecursively());
        QVERIFY(isRefused());
        driver.closeWriteChannel();
        QVERIFY(driver.waitForFinished());
        QCOMPARE(driver.exitStatus(), QProcess::NormalExit);
    }

    void brokenDriversAreRecognised_data()
    {
        QTest::addColumn<QString>("demand");
        QTest::addColumn<QString>("told");
        QTest::newRow("silent at hello") << "sends hello"
                                         << "no hello in time";
        QTest::newRow("other schema") << "sends hello"
                                      << "acme/7";
        QTest::newRow("no name") << "sends hello"
                                 << "no name";
        QTest::newRow("wild name") << "sends hello"
                                   << "the name in its hello has 5004 bytes";
        QTest::newRow("endless line") << "sends hello"
                                      << "longer than 65536 bytes";
        QTest::newRow("endless lines") << "sends only messages"
                                       << "not a message: x";
        QTest::newRow("babbles") << "sends only messages"
                                 << "Engine 2.1 is ready";
        QTest::newRow("answers twice") << "sends only messages"
                                       << "already answered";
        QTest::newRow("touched elsewhere") << "sends only messages"
                                           << "image 999999";
        QTest::newRow("touched before") << "sends only messages"
                                        << "which is not shown";
        QTest::newRow("echoes the schema") << "newer schema"
                                           << "display/99";
        QTest::newRow("shows at the start") << "nothing after hello"
                                            << "showing 1";
        QTest::newRow("hangs at an image") << "shows an image"
                                           << "no reply in time";
        QTest::newRow("dies at an image") << "shows an image"
                                          << "ended by signal 9";
        QTest::newRow("half a line") << "shows an image"
                                     << "ended with exit code 0";
        QTest::newRow("refuses images") << "shows an image"
                                        << "no amplifier";
        QTest::newRow("takes its own size only") << "1280 × 800 px, the size that sessions send"
                                                 << "only 40 x 30";
        QTest::newRow("answers an old id") << "sends only messages"
                                           << "request 1,";
        QTest::newRow("reads images as lines") << "does not interpret"
                                               << "";
        QTest::newRow("status is empty") << "in its status"
                                         << "showing nothing";
        QTest::newRow("never clears") << "clears in time"
                                      << "showing";
        QTest::newRow("hangs at clearing") << "clears in time"
                                           << "no reply in time";
        QTest::newRow("silent at the unknown") << "unknown request"
                                               << "no reply in time";
        QTest::newRow("ends at the unknown") << "unknown request"
                                             << "ended with exit code 0";
        QTest::newRow("continues without input") << "input ends"
                                                 << "it continued";
    }
    void brokenDriversAreRecognised()
    {
        QFETCH(QString, demand);
        QFETCH(QString, told);
        const auto check = checked(std::string("exec:" VIS2HAP_BROKEN_DISPLAY " '") + QTest::currentDataTag() + "'", impatient());
        const auto found = std::find_if(check.demands.begin(), check.demands.end(), [&](const DisplayDemand& one) {
            return QString::fromStdString(one.demand).contains(demand);
        });
        QVERIFY(found != check.demands.end());
        QVERIFY2(!found->fault.empty() && QString::fromStdString(found->fault).contains(told), qPrintable(faultsOf(check)));
    }

    void theSameDriverWithoutAFaultPasses()
    {
        for (const char* driver : {"exec:" VIS2HAP_BROKEN_DISPLAY " none", "exec:" VIS2HAP_BROKEN_DISPLAY " none fine"}) {
            const auto check = checked(driver, impatient());
            QVERIFY2(check.faults() == 0, qPrintable(faultsOf(check)));
        }
    }

    /// Response times would follow such a clock.
    void aClockThatTellsNoTimeIsRecognised_data()
    {
        QTest::addColumn<QString>("told");
        QTest::newRow("six digits") << "at_s advanced by 0.000 s while ";
        QTest::newRow("32 bits") << "at_s advanced by 0.000 s while ";
        QTest::newRow("whole seconds") << "at_s ";
        QTest::newRow("stands still") << "at_s advanced by 0.000 s while ";
        QTest::newRow("steps back") << "at_s went back by ";
    }
    void aClockThatTellsNoTimeIsRecognised()
    {
        QFETCH(QString, told);
        const auto check =
            checked(std::string("exec:" VIS2HAP_BROKEN_DISPLAY " none '") + QTest::currentDataTag() + "'", impatient());
        QCOMPARE(check.faults(), 1);
        const auto found = std::ranges::find_if(check.demands, [](const DisplayDemand& one) { return !one.fault.empty(); });
        QVERIFY2(found->demand.find("a clock that advances as ours does") != std::string::npos &&
                     QString::fromStdString(found->fault).startsWith(told),
                 qPrintable(faultsOf(check)));
    }

    void programThatDoesNotStartFailsEveryDemand()
    {
        const auto check = checked("exec:/nowhere/driver", impatient());
        QVERIFY(check.demands.front().fault.find("exit code 127") != std::string::npos);
        QVERIFY(check.demands.front().fault.find("not found") != std::string::npos);
        QCOMPARE(check.faults(), static_cast<int>(check.demands.size()));
    }
};

QTEST_GUILESS_MAIN(DisplayConformanceTest)
#include "display_conformance_test.moc"
