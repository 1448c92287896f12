// A display behind its owner's driver, as a session uses it: shown images, reported touches, and drivers that end, hang
// or send nonsense.
#include "rendering/display/external_display.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <thread>

#include "protocols/random.h"
#include "rendering/images/image_io.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using namespace std::chrono_literals;

namespace {

const cv::Mat grey(800, 1280, CV_8UC1, cv::Scalar(77));

DriverAddress program(const std::string& command) { return {command, {}, {}}; }

DriverAddress broken(const std::string& fault, const std::string& clock = {})
{
    return program(std::string(VIS2HAP_BROKEN_DISPLAY " '") + fault + "' '" + clock + "'");
}

Instant at(double seconds)
{
    return Instant(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(1000 + seconds)));
}

/// The most that the age of a touch is wrong by, s, over 40 presentations. Every second touch is read `delayS` late. `stampAt` is
/// the device's clock.
template <class Clock>
double worstAgeS(const Clock& stampAt, double delayS)
{
    DeviceClock clock;
    double worst = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const double beganS = trial * 31.4159, shownS = beganS + 9.7, touchedS = shownS + 0.37 + 0.0613 * trial;
        clock.take({stampAt(beganS), at(beganS + 0.001), at(beganS - 0.002)});
        clock.take({stampAt(shownS), at(shownS + 0.001), at(shownS - 0.02)});
        const double lateS = trial % 2 == 0 ? 0 : delayS;
        const StampedEvent touch{stampAt(touchedS), at(touchedS + 0.001 + lateS), at(shownS - 0.02)};
        clock.take(touch);
        worst = std::max(worst, std::abs(std::chrono::duration<double>(clock.ageOf(touch)).count() - lateS));
    }
    return worst;
}

/// Stamps of a clock that ticks `perSecond` times a second.
auto ticking(double perSecond)
{
    return [perSecond](double s) { return std::floor((s + 86411.3) * perSecond) / perSecond; };
}

/// Moments of presentations: cleared, shown, touched and so on, s.
std::vector<double> irregularMoments(std::size_t count)
{
    protocols::Random random(20261207);
    std::vector<double> moments;
    for (double s = 0; moments.size() < count;) moments.push_back(s += random.uniform(1, 10));
    return moments;
}

const DriverPatience impatient{.reply = 300ms, .start = 500ms, .tries = 3};

/// A port without a listener: the system assigned it, and it was released.
int freePort()
{
    const int server = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in place{};
    socklen_t size = sizeof place;
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(server, reinterpret_cast<sockaddr*>(&place), sizeof place);
    ::getsockname(server, reinterpret_cast<sockaddr*>(&place), &size);
    ::close(server);
    return ntohs(place.sin_port);
}

/// Lets the display process its messages for a time, as an event loop would.
void attendFor(HapticDisplay& display, std::chrono::milliseconds duration)
{
    const auto end = std::chrono::steady_clock::now() + duration;
    while (std::chrono::steady_clock::now() < end) {
        pollfd waiting{display.descriptorToWatch(), POLLIN, 0};
        if (::poll(&waiting, 1, 10) > 0) display.processMessages();
    }
}

}  // namespace

class ExternalDisplayTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_folder;

    std::filesystem::path folder() { return m_folder.filePath(QTest::currentTestFunction()).toStdString(); }
    DriverAddress reference(const std::string& options = {})
    {
        return program(VIS2HAP_REFERENCE_DISPLAY " " + folder().string() + " " + options);
    }
    cv::Mat felt() { return readPgm(folder() / "current.pgm"); }

private Q_SLOTS:
    void imageIsFeltWhenShowReturnsAndGoneWhenCleared()
    {
        ExternalDisplay display(reference());
        QVERIFY(display.name().find("reference display") != std::string::npos);
        QCOMPARE(cv::countNonZero(felt()), 0);
        cv::Mat image(800, 1280, CV_8UC1);
        for (int i = 0; i < image.rows * image.cols; ++i) image.data[i] = static_cast<unsigned char>(i * 7 % 256);
        display.show(image);
        QCOMPARE(cv::norm(felt(), image, cv::NORM_INF), 0.0);
        display.show(image.colRange(100, 500));  // Rows that are not contiguous in memory.
        QCOMPARE(cv::norm(felt(), image.colRange(100, 500), cv::NORM_INF), 0.0);
        display.clear();
        QCOMPARE(cv::countNonZero(felt()), 0);
    }

    void nothingIsFeltOnceTheProgramIsGone()
    {
        {
            ExternalDisplay display(reference());
            display.show(grey);
        }
        QCOMPARE(cv::countNonZero(felt()), 0);
    }

    void theDriverGetsNoSecretOfTheOwner()
    {
        qputenv("PGPASSWORD", "Sekret1");
        qputenv("VIS2HAP_PASSPHRASE", "Sekret2");
        qputenv("OF_THE_LAB", "kept");
        const std::string seen = m_folder.filePath("environment").toStdString();
        {
            ExternalDisplay display(program("env > '" + seen + "'; exec " + reference().command));
            display.show(grey);
        }
        qunsetenv("PGPASSWORD");
        qunsetenv("VIS2HAP_PASSPHRASE");
        qunsetenv("OF_THE_LAB");
        QFile file(QString::fromStdString(seen));
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QByteArray variables = file.readAll();
        QVERIFY(variables.contains("OF_THE_LAB=kept"));
        QVERIFY(!variables.contains("Sekret1") && !variables.contains("PGPASSWORD"));
        QVERIFY(!variables.contains("Sekret2") && !variables.contains("VIS2HAP_PASSPHRASE"));
    }

    void aWaitForADriverCanBeStopped_data()
    {
        QTest::addColumn<QString>("specification");
        QTest::newRow("program") << "exec:exec sleep 60";
        QTest::newRow("program that does not end when asked") << "exec:trap '' TERM; sleep 60 & wait";
    }
    void aWaitForADriverCanBeStopped()
    {
        QFETCH(QString, specification);
        std::stop_source stop;
        QElapsedTimer waited;
        std::thread presser([&] {
            std::this_thread::sleep_for(200ms);
            waited.start();
            stop.request_stop();
        });
        const QString refusal = refusalOf([&] { openDisplay(specification.toStdString(), stop.get_token()); });
        presser.join();
        QVERIFY2(!refusal.isEmpty() && waited.elapsed() < 900, qPrintable(refusal + QString::number(waited.elapsed())));
    }

    void touchIsReportedWithItsAge()
    {
        ExternalDisplay display(reference("--touch-after 40"));
        QVERIFY(display.reportsTouches());
        std::vector<Touch> touches;
        display.onTouched([&](const Touch& touch) { touches.push_back(touch); });
        display.show(grey);
        attendFor(display, 200ms);
        QCOMPARE(touches.size(), std::size_t(1));
        display.show(grey);
        std::this_thread::sleep_for(240ms);  // The window is busy while the finger comes down.
        attendFor(display, 50ms);
        QCOMPARE(touches.size(), std::size_t(2));
        // Reported 200 ms late, with this delay as its age.
        QVERIFY2(touches.back().ago > 120ms && touches.back().ago > touches.front().ago,
                 qPrintable(QString::number(touches.back().ago.count())));
    }

    /// Wrong stamps must not make response times longer; the touch then counts as read at once.
    void aClockThatTellsNoTimeDatesNoTouch_data()
    {
        QTest::addColumn<QString>("deviceClock");
        for (const char* one : {"fine", "six digits", "32 bits", "whole seconds", "stands still", "steps back"})
            QTest::newRow(one) << one;
    }
    void aClockThatTellsNoTimeDatesNoTouch()
    {
        QFETCH(QString, deviceClock);
        ExternalDisplay display(broken("touched late", deviceClock.toStdString()));
        std::vector<Touch> touches;
        display.onTouched([&](const Touch& touch) { touches.push_back(touch); });
        for (std::size_t image = 1; image <= 2; ++image) {
            display.show(grey);
            attendFor(display, 500ms);
            QCOMPARE(touches.size(), image);
            QVERIFY2(touches.back().ago < 100ms, qPrintable(QString::number(touches.back().ago.count())));
            display.clear();
        }
    }

    void agesFollowASoundClockAndNoOther()
    {
        const auto rounded = [](double unit) { return [unit](double s) { return std::round((s + 86411.3) / unit) * unit; }; };
        for (const double startS : {0.0, 1.79e9}) {
            QVERIFY(worstAgeS([&](double s) { return startS + s; }, 0.3) < 0.002);
            // A clock that is 100 millionths slower drifts 10 ms over the eight stamps.
            QVERIFY(worstAgeS([&](double s) { return startS + s * 0.9999; }, 0.3) < 0.012);
            QVERIFY(worstAgeS([&](double s) { return startS + s - (s > 300 ? 1.5 : 0); }, 0.3) < 0.002);  // set back at rest
        }
        QVERIFY(worstAgeS(rounded(0.001), 0.3) < 0.003);
        for (const double unit : {0.1, 0.5, 1.0, 10.0, 1e4}) QVERIFY(worstAgeS(rounded(unit), 0) < 0.002);
        QVERIFY(worstAgeS([](double s) { return double(float(1.79e9 + s)); }, 0) < 0.002);
        QVERIFY(worstAgeS([](double s) { return double(float(6e5 + s)); }, 0) < 0.002);  // a week of uptime
        QVERIFY(worstAgeS([](double) { return 12.0317; }, 0) < 0.002);
        QVERIFY(worstAgeS([](double s) { return 5000 - s; }, 0) < 0.002);
        // Set back between an image and its touch, by any amount.
        for (const double byS : {0.05, 1.5, 3600.0}) {
            const double shownS = 10 * 31.4159 + 9.7;
            QVERIFY(worstAgeS([&](double s) { return 4321 + s - (s > shownS + 0.1 ? byS : 0); }, 0) < 0.06);
        }
    }

    /// A finger that rests on the display touches an image in the moment when it appears. Its window reads that late.
    void aTouchInTheMomentOfItsImageKeepsItsAge_data()
    {
        QTest::addColumn<double>("stampedEarlierS");
        QTest::newRow("in the same millisecond") << 0.0;
        QTest::newRow("stamped a little before the reply") << 0.004;
    }
    void aTouchInTheMomentOfItsImageKeepsItsAge()
    {
        QFETCH(double, stampedEarlierS);
        const auto stampAt = ticking(1000);
        DeviceClock clock;
        const auto ageMs = [&](const StampedEvent& event) { return static_cast<double>(clock.ageOf(event).count()) / 1e6; };
        for (int trial = 0; trial < 4; ++trial) {
            const double clearedS = trial * 20.0137, shownS = clearedS + 9.0041;
            clock.take({stampAt(clearedS), at(clearedS + 0.001), at(clearedS - 0.002)});
            clock.take({stampAt(shownS), at(shownS + 0.001), at(shownS - 0.02)});
            const StampedEvent touch{stampAt(shownS) - stampedEarlierS, at(shownS + 0.06), at(shownS - 0.02)};
            clock.take(touch);
            QVERIFY2(std::abs(ageMs(touch) - 60 - 1000 * stampedEarlierS) < 3, qPrintable(QString::number(ageMs(touch))));
            // The samples of the finger that waited with it.
            for (const double agoS : {0.05, 0.03, 0.0}) {
                const double sampleMs = ageMs({stampAt(shownS + 0.06 - agoS), at(shownS + 0.06), at(shownS - 0.02)});
                QVERIFY2(std::abs(sampleMs - 1000 * agoS) < 3, qPrintable(QString::number(sampleMs)));
            }
        }
    }

    /// Such clocks are sound, although many of their stamps look rounded.
    void aClockThatTicksSlowlyDatesItsTouches_data()
    {
        QTest::addColumn<double>("perSecond");
        for (const double perSecond : {1000.0, 100.0, 64.0, 60.0, 40.0})
            QTest::addRow("%.0f times a second", perSecond) << perSecond;
    }
    void aClockThatTicksSlowlyDatesItsTouches()
    {
        QFETCH(double, perSecond);
        const auto stampAt = ticking(perSecond);
        DeviceClock clock;
        std::vector<double> moments = irregularMoments(6000);
        int lost = 0;
        for (std::size_t i = 0; i < moments.size(); i += 3) {
            for (const double s : {moments[i], moments[i + 1]}) clock.take({stampAt(s), at(s + 0.001), at(s - 0.002)});
            const StampedEvent touch{stampAt(moments[i + 2]), at(moments[i + 2] + 0.3), at(moments[i + 1] - 0.002)};
            clock.take(touch);
            if (clock.ageOf(touch) < 200ms) ++lost;
        }
        QVERIFY2(lost <= 2, qPrintable(QString("%1 of 2000").arg(lost)));  // the first of the connection, perhaps

        moments.resize(45);
        int refused = 0;
        for (int run = 0; run < 500; ++run) {
            DeviceClockCheck check;
            for (const double s : moments) check.take({stampAt(s + 0.0137 * run), at(s + 0.001), at(s - 0.002)});
            refused += check.fault().find("rounded") != std::string::npos ? 1 : 0;
        }
        QCOMPARE(refused, 0);
    }

    /// A display that takes a tenth of a second hides the steps, so that only the stamps themselves show them.
    void aRoundedClockIsNamedAfterTwelveStamps()
    {
        for (const double perSecond : {20.0, 32.0}) {
            DeviceClockCheck check;
            for (const double s : irregularMoments(12)) {
                QVERIFY2(check.fault().empty(), check.fault().c_str());
                check.take({std::round(s * perSecond) / perSecond, at(s + 0.05), at(s - 0.05)});
            }
            QVERIFY2(check.fault().find("at_s is rounded") == 0, check.fault().c_str());
        }
    }

    /// The display has not shown the image before it replies, whatever its touch screen reports.
    void noTouchIsDatedBeforeItsImage()
    {
        ExternalDisplay display(broken("touched early", "fine"));
        std::vector<Touch> touches;
        display.onTouched([&](const Touch& touch) { touches.push_back(touch); });
        for (std::size_t image = 1; image <= 3; ++image) {
            display.show(grey);
            attendFor(display, 50ms);
            QCOMPARE(touches.size(), image);
            QVERIFY2(touches.back().ago < 60ms, qPrintable(QString::number(touches.back().ago.count())));
        }
    }

    void touchBetweenTwoImagesIsIgnored()
    {
        ExternalDisplay display(reference("--touch-after 30"));
        int touches = 0;
        display.onTouched([&](const Touch&) { ++touches; });
        display.show(grey);
        std::this_thread::sleep_for(80ms);
        display.clear();
        attendFor(display, 60ms);
        QCOMPARE(touches, 0);
    }

    void touchThatComesWithTheReplyIsReported()
    {
        ExternalDisplay display(reference("--touch-after 0"));
        int touches = 0;
        display.onTouched([&](const Touch&) { ++touches; });
        for (int image = 1; image <= 20; ++image) {
            display.show(grey);
            attendFor(display, 20ms);
            QCOMPARE(touches, image);
        }
    }

    void samplesOfTheFingerAreReportedWhileAnImageIsShown()
    {
        ExternalDisplay display(reference("--touch-after 20 --finger-every 5"));
        std::vector<FingerReport> samples;
        display.onFinger([&](const FingerReport& sample) { samples.push_back(sample); });
        display.show(grey);
        attendFor(display, 300ms);
        QVERIFY2(samples.size() > 20 && samples.size() < 70, qPrintable(QString::number(samples.size())));
        for (std::size_t i = 0; i < samples.size(); ++i) {
            QVERIFY(samples[i].yMm == 20.0 && samples[i].forceN == 0.5);
            QVERIFY(*samples[i].xMm >= 20 && *samples[i].xMm <= 60);
        }
        const std::size_t before = samples.size();
        std::this_thread::sleep_for(200ms);  // The window is busy; the samples keep their own times.
        attendFor(display, 1ms);
        QVERIFY2(samples.size() > before && samples[before].ago > 100ms, qPrintable(QString::number(samples.size())));
        display.clear();
        const std::size_t atEnd = samples.size();
        attendFor(display, 60ms);
        QCOMPARE(samples.size(), atEnd);
    }

    void nonsenseOfTheFingerIsIgnored()
    {
        ExternalDisplay display(broken("fingers of nonsense"), impatient);
        std::vector<FingerReport> samples;
        display.onFinger([&](const FingerReport& sample) { samples.push_back(sample); });
        display.show(grey);
        attendFor(display, 50ms);
        QCOMPARE(samples.size(), std::size_t(1));
        QCOMPARE(*samples[0].xMm, 7.5);
        QVERIFY(!samples[0].yMm && !samples[0].forceN);
    }

    /// A window that attends to the display is never held up, however much comes.
    void aFloodOfTheFingerHoldsNobodyUp()
    {
        ExternalDisplay display(broken("floods of fingers"));
        int samples = 0;
        display.onFinger([&](const FingerReport&) { ++samples; });
        QElapsedTimer timer;
        timer.start();
        display.show(grey);
        QVERIFY(timer.elapsed() < 1900);
        qint64 longest = 0;
        QElapsedTimer whole;
        whole.start();
        while (samples < 100000 && whole.elapsed() < 20000) {
            timer.restart();
            display.processMessages();
            longest = std::max(longest, timer.elapsed());
        }
        qInfo("%d samples in %lld ms; the longest turn took %lld ms", samples, whole.elapsed(), longest);
        QVERIFY2(samples >= 100000 && longest < 500, qPrintable(QString("%1 samples, %2 ms").arg(samples).arg(longest)));
        display.clear();
    }

    void driverThatDiesIsStartedAgain()
    {
        ExternalDisplay display(reference("--crash-at 2"));
        for (int image = 0; image < 4; ++image) display.show(grey);  // Every second image ends the driver.
        QCOMPARE(cv::norm(felt(), grey, cv::NORM_INF), 0.0);
        display.clear();
        QCOMPARE(cv::countNonZero(felt()), 0);
    }

    void driverThatDiesBetweenTrialsIsStartedAgainSilently()
    {
        ExternalDisplay display(broken("dies after clearing"), impatient);
        for (int trial = 0; trial < 3; ++trial) {
            QCOMPARE(refusalOf([&] { attendFor(display, 60ms); }), QString());
            QCOMPARE(refusalOf([&] { display.show(grey); }), QString());
            display.clear();
        }
    }

    void driverThatDiesWhileAnImageIsFeltIsReported()
    {
        ExternalDisplay display(broken("dies after an image"), impatient);
        display.show(grey);
        const auto told = refusalOf([&] { attendFor(display, 300ms); });
        QVERIFY2(told.contains("while an image was felt") && told.contains("signal 9"), qPrintable(told));
        QCOMPARE(refusalOf([&] { attendFor(display, 50ms); }), QString());  // Reported only once.
    }

    void faultOfADriverIsNamed_data()
    {
        QTest::addColumn<QString>("told");
        QTest::newRow("hangs at an image") << "does not answer \"shown\" within 0.3 s (tried 3 times)";
        QTest::newRow("dies at an image") << "was ended by signal 9";
        QTest::newRow("half a line") << "ended with exit code 0 (tried 3 times)";
        QTest::newRow("refuses images") << "refuses: no amplifier";
        QTest::newRow("babbles for ever") << "does not answer \"shown\" within 0.3 s; it sent instead: frame (tried 3 times)";
        QTest::newRow("answers an old id") << "does not answer \"shown\"";
    }
    void faultOfADriverIsNamed()
    {
        QFETCH(QString, told);
        ExternalDisplay display(broken(QTest::currentDataTag()), impatient);
        const auto fault = refusalOf([&] { display.show(grey); });
        QVERIFY2(fault.contains(told) && fault.contains("exec:") && fault.contains("display check"), qPrintable(fault));
        QElapsedTimer timer;
        timer.start();
        display.clear();  // One more try succeeds.
        QVERIFY(timer.elapsed() < 900);
    }

    void aLongCommandLeavesRoomForTheReason()
    {
        const std::string options = " --device /dev/serial/by-id/usb-" + std::string(300, '0') + " --log /var/log/driver.log";
        const auto fault = refusalOf([&] { ExternalDisplay(program("exit 7;" + options), impatient); });
        QVERIFY2(fault.startsWith("display exec:exit 7; --device /dev/serial/") && fault.contains("ended with exit code 7"),
                 qPrintable(fault));
        QVERIFY2(!fault.contains(QString(100, '0')) && !fault.contains("driver.log"), qPrintable(fault));
    }

    void reasonOfARefusalKeepsItsLanguage()
    {
        const std::string reply = R"({"type":"failed","id":1,"why":"Der Verstärker ist aus"})";
        const auto fault = refusalOf([&] { ExternalDisplay(program("read request; echo '" + reply + "'; cat"), impatient); });
        QVERIFY2(fault.contains("does not start: Der Verstärker ist aus"), qPrintable(fault));
    }

    void aWildNameIsShownInShort()
    {
        const std::string name = ExternalDisplay(broken("wild name"), impatient).name();
        QVERIFY2(name.size() < 2000 && name.find('\x1b') == std::string::npos, name.c_str());
    }

    void driverThatCannotStartIsReportedAtOnce_data()
    {
        QTest::addColumn<QString>("told");
        QTest::newRow("silent at hello") << "does not answer \"hello\" within 0.5 s";
        QTest::newRow("other schema") << "uses \"acme/7\", but this program uses vis2hap.display/1";
        QTest::newRow("endless line") << "longer than 65536 bytes";
        QTest::newRow("endless lines") << "";
    }
    void driverThatCannotStartIsReportedAtOnce()
    {
        QFETCH(QString, told);
        const auto fault = refusalOf([&] { ExternalDisplay(broken(QTest::currentDataTag()), impatient); });
        QVERIFY2(!fault.isEmpty() && fault.contains(told), qPrintable(fault));
    }

    void harmlessFaultsAreTolerated_data()
    {
        QTest::addColumn<QString>("fault");
        for (const char* fault : {"babbles", "answers twice", "touched elsewhere", "floods its errors"})
            QTest::newRow(fault) << fault;
    }
    void harmlessFaultsAreTolerated()
    {
        QFETCH(QString, fault);
        ExternalDisplay display(broken(fault.toStdString()), impatient);
        int touches = 0;
        display.onTouched([&](const Touch&) { ++touches; });
        for (int image = 0; image < 3; ++image) {
            display.show(grey);
            attendFor(display, 20ms);
            display.clear();
        }
        QCOMPARE(touches, 0);
    }

    void errorTextOfADeadDriverIsReported()
    {
        qputenv("BROKEN_DISPLAY_MARK", m_folder.filePath("died").toUtf8());
        ExternalDisplay display(broken("dies at the first image"), {.reply = 2s, .start = 2s, .tries = 1});
        const auto fault = refusalOf([&] { display.show(grey); });
        QVERIFY2(fault.contains("exit code 3; its error text: cannot open the amplifier"), qPrintable(fault));
        display.show(grey);  // Repaired.
    }

    void closedPortIsReportedAtOnce()
    {
        const auto port = std::to_string(freePort());
        const auto fault = refusalOf([&] { ExternalDisplay(DriverAddress{{}, "127.0.0.1", port}, impatient); });
        QVERIFY2(fault.contains("the display's driver cannot be reached (Connection refused)") &&
                     fault.contains("tcp:127.0.0.1:" + QString::fromStdString(port)),
                 qPrintable(fault));
    }

    void addressesAreRead_data()
    {
        QTest::addColumn<QString>("specification");
        QTest::addColumn<QString>("host");
        QTest::addColumn<QString>("port");
        QTest::newRow("name") << "tcp:lab-pc:7000"
                              << "lab-pc"
                              << "7000";
        QTest::newRow("version 6") << "tcp:[::1]:7000"
                                   << "::1"
                                   << "7000";
        QTest::newRow("without port") << "tcp:lab-pc"
                                      << ""
                                      << "";
        QTest::newRow("without host") << "tcp::7000"
                                      << ""
                                      << "";
        QTest::newRow("without command") << "exec: "
                                         << ""
                                         << "";
    }
    void addressesAreRead()
    {
        QFETCH(QString, specification);
        QFETCH(QString, host);
        QFETCH(QString, port);
        std::optional<DriverAddress> address;
        const auto refusal = refusalOf([&] { address = driverAddressFrom(specification.toStdString()); });
        QCOMPARE(refusal.isEmpty(), !host.isEmpty());
        if (!address) return;
        QCOMPARE(address->host, host.toStdString());
        QCOMPARE(address->port, port.toStdString());
        QCOMPARE(address->text(), specification.toStdString());
    }

    void spoiltMessagesDoNoHarm()
    {
        // Every line that a driver may send, with some bytes replaced at random.
        const std::string lines[] = {
            "{\"type\":\"hello\",\"id\":1,\"schema\":\"vis2hap.display/"
            "1\",\"name\":\"A\",\"width\":40,\"height\":30,\"touches\":true}",
            "{\"type\":\"shown\",\"id\":2,\"at_s\":12.5}", "{\"type\":\"status\",\"id\":4,\"showing\":null}",
            "{\"type\":\"touched\",\"id\":2,\"at_s\":1e3}", "{\"type\":\"failed\",\"id\":2,\"why\":\"\\u00e4\"}"};
        protocols::Random random(20261121);
        int understood = 0;
        for (int round = 0; round < 40000; ++round) {
            std::string line = lines[random.below(std::size(lines))];
            for (std::uint64_t change = random.below(4); change > 0; --change)
                line[random.below(line.size())] = static_cast<char>(random.below(256));
            if (random.below(8) == 0) line.resize(random.below(line.size()));
            const auto said = driverMessageFrom(line);
            if (!said) continue;
            ++understood;
            QVERIFY(said->id >= 0 && said->widthPx >= 0 && said->heightPx >= 0);
            QVERIFY(!said->deviceS || std::isfinite(*said->deviceS));
        }
        QVERIFY(understood > 5000 && understood < 39000);
    }

    /// The time to read a line grows with its length, not with the square of its fields.
    void linesOfManyFieldsAreReadQuickly()
    {
        std::string line = R"({"type":"status","id":3)";
        for (int i = 0; i < 8000; ++i) line += ",\"" + std::to_string(i) + "\":0";
        line += "}";
        QElapsedTimer timer;
        timer.start();
        for (int i = 0; i < 40; ++i) QVERIFY(driverMessageFrom(line).has_value());
        QVERIFY2(timer.elapsed() < 3000, qPrintable(QString::number(timer.elapsed())));
    }

    void messagesAreReadAsTheyAreWritten_data()
    {
        QTest::addColumn<QByteArray>("line");
        QTest::addColumn<bool>("isMessage");
        QTest::newRow("shown") << QByteArray(R"({"type":"shown","id":3})") << true;
        QTest::newRow("as a float") << QByteArray(R"({"type":"shown","id":3.0,"at_s":12.5})") << true;
        QTest::newRow("more fields") << QByteArray(R"({"type":"status","id":3,"showing":null,"volts":[1,2]})") << true;
        QTest::newRow("a doubled field: the last counts") << QByteArray(R"({"type":"shown","id":4,"id":3})") << true;
        QTest::newRow("no id") << QByteArray(R"({"type":"shown"})") << false;
        QTest::newRow("half an id") << QByteArray(R"({"type":"shown","id":3.5})") << false;
        QTest::newRow("negative id") << QByteArray(R"({"type":"shown","id":-3})") << false;
        QTest::newRow("id as text") << QByteArray(R"({"type":"shown","id":"3"})") << false;
        QTest::newRow("unknown type") << QByteArray(R"({"type":"sown","id":3})") << false;
        QTest::newRow("no object") << QByteArray("[3]") << false;
        QTest::newRow("nothing") << QByteArray("") << false;
        QTest::newRow("no JSON") << QByteArray("ready.") << false;
        QTest::newRow("no UTF-8") << QByteArray("{\"type\":\"shown\",\"id\":3,\"why\":\"\xff\"}") << false;
        QTest::newRow("nested") << QByteArray(60000, '[') << false;
        QTest::newRow("name as number") << QByteArray(R"({"type":"hello","id":3,"name":5})") << false;
    }
    void messagesAreReadAsTheyAreWritten()
    {
        QFETCH(QByteArray, line);
        QFETCH(bool, isMessage);
        const auto said = driverMessageFrom(line.toStdString());
        QCOMPARE(said.has_value(), isMessage);
        if (said) QCOMPARE(said->id, std::int64_t(3));
    }
};

QTEST_GUILESS_MAIN(ExternalDisplayTest)
#include "external_display_test.moc"
