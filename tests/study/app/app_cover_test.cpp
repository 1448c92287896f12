// Cover of a touch screen: it is black, takes no keyboard focus and reports touches. The tests use two screens of the
// offscreen platform. With one screen they are skipped with a message.
#include <poll.h>

#include <QApplication>
#include <QFile>
#include <QLabel>
#include <QPointingDevice>
#include <QScreen>
#include <QTest>
#include <opencv2/core/mat.hpp>

#include "protocols/files/errors.h"
#include "study/app/state/screen_cover.h"
#include "tests/support/open_window.h"
#include "tests/support/played_session.h"

using namespace study::app;
using namespace study::session;
using tests::support::OpenWindow;
using tests::support::ShownWindow;

namespace {

constexpr auto twoScreens = R"({"screens": [
    {"name": "console", "x": 0, "y": 0, "width": 1200, "height": 800, "logicalDpi": 96, "logicalBaseDpi": 96, "dpr": 1},
    {"name": "film", "x": 1200, "y": 0, "width": 1280, "height": 800, "logicalDpi": 96, "logicalBaseDpi": 96, "dpr": 1}]})";

QWidget* cover()
{
    for (QWidget* window : QApplication::topLevelWidgets())
        if (window->objectName() == "screenCover") return window;
    return nullptr;
}

QString faultOf(const std::string& specification)
{
    try {
        openDisplay(specification);
        return {};
    } catch (const protocols::Error& fault) {
        return QString::fromUtf8(fault.what());
    }
}

}  // namespace

class AppCoverTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        if (QGuiApplication::screens().size() < 2) QSKIP("the platform has only one screen");
    }
    void coversItsScreenWithBlack();
    void reportsFingersAndMouse();
    void passesImagesToTheWrappedDisplay();
    void touchesOfTheWrappedDriverAreReported();
    void missingScreensAreRefused_data();
    void missingScreensAreRefused();
    void touchOfTheCoverIsStampedInASession();
    void aCoverAloneIsNoDisplay();
};

void AppCoverTest::coversItsScreenWithBlack()
{
    const auto display = openDisplay("cover:1");
    QVERIFY(display->reportsTouches());
    QVERIFY(cover());
    QCOMPARE(cover()->geometry(), QGuiApplication::screens()[1]->geometry());
    QVERIFY(cover()->windowTitle().isEmpty());
    const QImage seen = cover()->grab().toImage();
    for (const QPoint at : {QPoint(0, 0), seen.rect().center(), seen.rect().bottomRight()})
        QCOMPARE(seen.pixelColor(at), QColor(Qt::black));
}

void AppCoverTest::reportsFingersAndMouse()
{
    const auto display = openDisplay("cover:1");
    int touches = 0;
    display->onTouched([&](const rendering::Touch&) { ++touches; });
    QTest::mousePress(cover(), Qt::LeftButton);
    QCOMPARE(touches, 1);
    QTest::mouseMove(cover(), QPoint(5, 5));
    QTest::mouseRelease(cover(), Qt::LeftButton);
    QCOMPARE(touches, 1);
    const std::unique_ptr<QPointingDevice> film(QTest::createTouchDevice());
    QTest::touchEvent(cover(), film.get()).press(0, QPoint(100, 100), cover());
    QCOMPARE(touches, 2);
    QTest::touchEvent(cover(), film.get()).move(0, QPoint(160, 100), cover());
    QTest::touchEvent(cover(), film.get()).release(0, QPoint(160, 100), cover());
    QCOMPARE(touches, 2);
}

void AppCoverTest::passesImagesToTheWrappedDisplay()
{
    const std::string folder = filePath("watched, by a device").toStdString();
    const auto display = openDisplay("folder:" + folder + ",cover:1");
    QVERIFY(QString::fromStdString(display->name()).contains("watched, by a device"));
    display->show(cv::Mat(8, 8, CV_8UC1, cv::Scalar(200)));
    QFile image(QString::fromStdString(folder + "/current.pgm"));
    QVERIFY(image.open(QIODevice::ReadOnly));
    QVERIFY(image.readAll().contains(char(200)));
}

void AppCoverTest::touchesOfTheWrappedDriverAreReported()
{
    const auto display =
        openDisplay("exec:" VIS2HAP_REFERENCE_DISPLAY " '" + filePath("felt").toStdString() + "' --touch-after 10,cover:1");
    int touches = 0;
    display->onTouched([&](const rendering::Touch&) { ++touches; });
    display->show(cv::Mat(8, 8, CV_8UC1, cv::Scalar(200)));
    pollfd waiting{display->descriptorToWatch(), POLLIN, 0};
    QCOMPARE(::poll(&waiting, 1, 5000), 1);
    display->processMessages();
    QCOMPARE(touches, 1);
    QTest::mousePress(cover(), Qt::LeftButton);
    QCOMPARE(touches, 2);
}

void AppCoverTest::missingScreensAreRefused_data()
{
    QTest::addColumn<QString>("specification");
    QTest::addColumn<QString>("expectedText");
    QTest::newRow("beyond the last") << "cover:2"
                                     << "no screen 2";
    QTest::newRow("no number") << "cover:left"
                               << "no screen left";
    QTest::newRow("nothing") << "none,cover:"
                             << "no screen";
    QTest::newRow("negative") << "cover:-1"
                              << "no screen -1";
    QTest::newRow("unknown kind under it") << "magic,cover:1"
                                           << "unknown display";
}

void AppCoverTest::missingScreensAreRefused()
{
    QFETCH(QString, specification);
    QFETCH(QString, expectedText);
    const QString fault = faultOf(specification.toStdString());
    QVERIFY2(fault.contains(expectedText), qPrintable(fault));
    QVERIFY(!cover());
}

void AppCoverTest::touchOfTheCoverIsStampedInASession()
{
    const auto clock = std::make_shared<VirtualClock>();
    AppOptions options;
    options.clock = clock;
    options.display = "cover:1";
    ShownWindow shown(options);
    shown.window.openStudy(newStudy().folder);
    shown.window.startSession(protocols::ParticipantId("P01"));
    while (!std::holds_alternative<Presenting>(shown.gui.view().state.stage))
        QVERIFY(!shown.gui.perform(*tests::support::nextEvent(shown.gui.view(), shown.gui.plan())));
    clock->advanceSeconds(2);
    QTest::mousePress(cover(), Qt::LeftButton);
    const auto& presenting = std::get<Presenting>(shown.gui.view().state.stage);
    QCOMPARE(presenting.touchedAtNs.value_or(0), clock->monotonicNs());
    QVERIFY(presenting.touchedBy == TouchSource::Display);
    shown.gui.pressKey(Qt::Key_Q);
    QTRY_VERIFY(!cover());  // the screen is free again
}

/// A cover without a device renders nothing, so the operator must choose a rehearsal.
void AppCoverTest::aCoverAloneIsNoDisplay()
{
    AppOptions options;
    options.display = "cover:1";
    options.isDisplayGiven = true;
    ShownWindow shown(options);
    shown.window.openStudy(newStudy().folder);
    shown.gui.click("enrolButton");
    QVERIFY(!shown.window.session() && !cover());
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("displayPage"));
    shown.gui.click("rehearseButton");
    QVERIFY(shown.window.session());
    QCOMPARE(shown.widget<QLabel>("displayFact").text(), QStringLiteral("NO DISPLAY: rehearsal"));
}

int main(int argc, char** argv)
{
    QTemporaryDir folder;
    QFile screens(folder.filePath("screens.json"));
    if (qEnvironmentVariable("QT_QPA_PLATFORM") == "offscreen" && screens.open(QIODevice::WriteOnly)) {
        screens.write(twoScreens);
        screens.close();
        qputenv("QT_QPA_PLATFORM", ("offscreen:configfile=" + screens.fileName()).toUtf8());
    }
    QApplication application(argc, argv);
    AppCoverTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "app_cover_test.moc"
