// The check that the owner of a display runs: the reference driver meets every requirement, and each deliberately broken
// driver is recognised by name.
#include <QCoreApplication>
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

/// The reference driver behind a port that the system chooses.
class Listening {
public:
    explicit Listening(const QStringList& arguments)
    {
        m_process.start(QString::fromStdString(reference()), arguments + QStringList{"--listen", "0"});
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
        QCOMPARE(check.demands.size(), std::size_t(arguments.contains("--touch-after") ? 17 : 16));
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
        const auto check = checked("exec:" VIS2HAP_BROKEN_DISPLAY " none", impatient());
        QVERIFY2(check.faults() == 0, qPrintable(faultsOf(check)));
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
