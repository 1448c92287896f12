// The drivers that owners of a display copy. Each one is built and started as its README says: the check finds no fault, what is
// shown is what the device gets, and nothing can be felt after the end. Without a compiler or Python a row is skipped, aloud.
#include <QProcess>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <opencv2/core.hpp>

#include "rendering/composition/friction_image.h"
#include "rendering/display/display.h"
#include "rendering/display/display_check.h"
#include "rendering/images/image_io.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using namespace std::chrono_literals;

namespace {

const QString sources = QStringLiteral(VIS2HAP_SOURCE_DIR "/rendering/display/drivers/");

QString faultsIn(const DisplayCheck& check)
{
    QStringList faults;
    for (const auto& demand : check.demands)
        if (!demand.fault.empty()) faults << QString::fromStdString(demand.demand + ": " + demand.fault);
    return faults.join("\n");
}

/// Short times, because nobody answers.
DisplayCheckOptions impatient()
{
    DisplayCheckOptions options;
    options.patience = {.reply = 300ms, .start = 600ms, .tries = 1};
    return options;
}

cv::Mat ramp()
{
    cv::Mat image(displayHeightPx, displayWidthPx, CV_8U);
    for (int row = 0; row < image.rows; ++row)
        for (int column = 0; column < image.cols; ++column)
            image.at<std::uint8_t>(row, column) = cv::saturate_cast<std::uint8_t>((row + column) % 256);
    return image;
}

}  // namespace

class SmallDriversTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_folder;

    QString felt() const { return m_folder.filePath("felt.pgm"); }

    /// The words that start a driver; empty where its compiler or interpreter is missing.
    QStringList words(const QString& language) const
    {
        QStringList found;
        if (language == "Python") {
            const QString python = QStandardPaths::findExecutable("python3");
            if (!python.isEmpty()) found << python << sources + "small_driver.py";
            return found;
        }
        const QString compiler = QStandardPaths::findExecutable("c++"), program = m_folder.filePath("small_driver");
        if (compiler.isEmpty()) return found;
        QStringList arguments{"-std=c++17", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror"};
        arguments << "-o" << program << sources + "small_driver.cpp";
        found << (QProcess::execute(compiler, arguments) == 0 ? program : QString("small_driver.cpp does not compile"));
        return found;
    }

    void languages() const
    {
        QTest::addColumn<QString>("language");
        QTest::newRow("C++") << "C++";
        QTest::newRow("Python") << "Python";
    }

private Q_SLOTS:
    void aStartedDriverMeetsEveryDemand_data() { languages(); }
    void aStartedDriverMeetsEveryDemand()
    {
        QFETCH(QString, language);
        const QStringList driver = words(language);
        if (driver.isEmpty()) QSKIP(qPrintable("no compiler or interpreter for " + language));
        const std::string specification = "exec:" + (driver + QStringList{felt()}).join(' ').toStdString();
        const auto check = checkDisplay(driverAddressFrom(specification).value());
        QVERIFY2(check.faults() == 0, qPrintable(faultsIn(check)));
        QCOMPARE(check.demands.size(), std::size_t(18));
        QCOMPARE(QString::fromStdString(check.name), "small driver in " + language);

        const cv::Mat image = ramp();
        auto display = openDisplay(specification);
        display->show(image);
        QCOMPARE(cv::norm(readPgm(felt().toStdString()), image, cv::NORM_INF), 0.0);
        display->clear();
        QCOMPARE(cv::countNonZero(readPgm(felt().toStdString())), 0);
        display->show(image);
        display.reset();  // ends the program; the glass must be blank then
        QTRY_COMPARE(cv::countNonZero(readPgm(felt().toStdString())), 0);
    }

    void aListeningDriverServesOneComputerAfterTheOther_data() { languages(); }
    void aListeningDriverServesOneComputerAfterTheOther()
    {
        QFETCH(QString, language);
        QStringList driver = words(language);
        if (driver.isEmpty()) QSKIP(qPrintable("no compiler or interpreter for " + language));
        QProcess process;
        const QString program = driver.takeFirst();
        process.start(program, driver << felt() << "0");
        while (process.state() != QProcess::NotRunning && !process.canReadLine()) process.waitForReadyRead(1000);
        const auto told = QRegularExpression("port (\\d+)").match(QString::fromUtf8(process.readLine()));
        const std::string specification = "tcp:127.0.0.1:" + told.captured(1).toStdString();
        for (int computer = 0; computer < 2; ++computer) {
            const auto check = checkDisplay(driverAddressFrom(specification).value());
            QVERIFY2(check.faults() == 0, qPrintable(faultsIn(check)));
        }
        // With a port alone nobody outside this computer can connect.
        const auto elsewhere = checkDisplay({{}, "127.0.0.2", told.captured(1).toStdString()}, impatient());
        QVERIFY(elsewhere.demands.front().fault.find("cannot be reached") != std::string::npos);
        QVERIFY(process.state() == QProcess::Running);
        process.kill();
        process.waitForFinished();
    }

    void aWrongPortIsRefused_data() { languages(); }
    void aWrongPortIsRefused()
    {
        QFETCH(QString, language);
        QStringList driver = words(language);
        if (driver.isEmpty()) QSKIP(qPrintable("no compiler or interpreter for " + language));
        const QString program = driver.takeFirst();
        for (const char* port : {"abc", "99999", "7126x"}) {
            QProcess process;
            process.start(program, driver + QStringList{felt(), port});
            QVERIFY2(process.waitForFinished(10000) && process.exitCode() != 0, port);
        }
    }

    void hostileRequestsGetAReply_data() { languages(); }
    void hostileRequestsGetAReply()
    {
        QFETCH(QString, language);
        QStringList driver = words(language);
        if (driver.isEmpty()) QSKIP(qPrintable("no compiler or interpreter for " + language));
        QProcess process;
        const QString program = driver.takeFirst();
        process.start(program, driver << felt());
        process.write(R"({"type":"show","id":2,"width":"x","height":1,"bytes":1})"
                      "\nZ");
        process.write("show me\n");
        process.write(R"({"type":"clear","id":)" + QByteArray(30000, '[') + "\n");
        process.write(R"({"type":"status","id":5})"
                      "\n");
        QByteArrayList replies;
        while (replies.size() < 4 && (process.canReadLine() || process.waitForReadyRead(5000)))
            while (process.canReadLine()) replies << process.readLine();
        QCOMPARE(replies.size(), 4);
        QVERIFY2(replies[0].contains("failed") && replies[0].contains('2'), replies[0].constData());
        QVERIFY2(replies[1].contains("failed"), replies[1].constData());
        QVERIFY2(replies[3].contains("status") && replies[3].contains('5'), replies[3].constData());
        process.write(QByteArray(70000, 'x'));  // a line without an end
        QVERIFY(process.waitForFinished());     // although the input is still open
        QCOMPARE(process.exitCode(), 0);
    }

    void theOperatorReadsWhyTheEngineFails_data() { languages(); }
    void theOperatorReadsWhyTheEngineFails()
    {
        QFETCH(QString, language);
        const QStringList driver = words(language);
        if (driver.isEmpty()) QSKIP(qPrintable("no compiler or interpreter for " + language));
        QVERIFY(QDir(m_folder.path()).mkpath("engine"));
        const QString image = m_folder.filePath("engine/felt.pgm");
        auto display = openDisplay("exec:" + (driver + QStringList{image}).join(' ').toStdString());
        QVERIFY(QDir(m_folder.filePath("engine")).removeRecursively());
        const QString fault = refusalOf([&] { display->show(ramp()); });
        const QString reason = language == "Python" ? "No such file" : "the engine cannot write its image";
        QVERIFY2(fault.contains(reason), qPrintable(fault));
        QVERIFY(QDir(m_folder.path()).mkpath("engine"));
        display->show(ramp());  // the driver has continued
        QVERIFY(cv::countNonZero(readPgm(image.toStdString())) > 0);
    }
};

QTEST_GUILESS_MAIN(SmallDriversTest)
#include "small_drivers_test.moc"
