// Session with a display driver in the real window: the displayed image at every stage, first touches, and a driver that
// dies during the session.
#include <signal.h>
#include <unistd.h>

#include <QFile>
#include <QImage>
#include <QLabel>
#include <QPlainTextEdit>
#include <QProcess>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <opencv2/core.hpp>

#include "rendering/images/image_io.h"
#include "study/app/state/screen_cover.h"
#include "study/session/session_record.h"
#include "tests/study/app/displayed_image.h"
#include "tests/support/open_window.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;
using namespace study::session;
using protocols::ParticipantId;
using tests::support::OpenWindow;
using tests::support::ShownWindow;

class AppDisplayTest : public tests::support::WindowTest {
    Q_OBJECT

    QString displayFolder() { return filePath(QString::fromLatin1(QTest::currentTestFunction()) + "-displayed"); }
    AppOptions with(const QString& display)
    {
        AppOptions options;
        options.display = display.toStdString();
        options.clock = m_clock = std::make_shared<VirtualClock>();
        return options;
    }
    AppOptions withReference(const QString& more = {})
    {
        return with(QStringLiteral("exec:" VIS2HAP_REFERENCE_DISPLAY " '%1' %2").arg(displayFolder(), more));
    }
    void begin(ShownWindow& shown, const database::StudyFolder& study, const std::string& participant = "P01")
    {
        shown.window.openStudy(study.folder);
        shown.window.startSession(ParticipantId(participant));
    }
    void step(ShownWindow& shown)
    {
        m_clock->advanceSeconds(1);
        if (const auto refusal = shown.gui.perform(*tests::support::nextEvent(shown.gui.view(), shown.gui.plan())))
            QFAIL(refusal->reason.c_str());
    }
    template <class Stage>
    void stepTo(ShownWindow& shown)
    {
        while (!std::holds_alternative<Stage>(shown.gui.view().state.stage)) step(shown);
    }
    /// The process of the driver is the one that has the display folder in its arguments.
    void killDriver()
    {
        QProcess list;
        list.start("ps", {"-eo", "pid,ppid,args"});
        QVERIFY(list.waitForFinished());
        for (const QString& line : QString::fromUtf8(list.readAllStandardOutput()).split('\n'))
            if (line.contains(displayFolder()) && line.contains("vis2hap-reference-display"))
                ::kill(line.trimmed().section(' ', 0, 0).toInt(), SIGKILL);
    }
    /// Keys do nothing for 0.7 s after the display has failed.
    static void waitForKeys() { QTest::qWait(750); }
    QString messageIn(ShownWindow& shown) { return shown.window.currentPage()->findChild<QLabel*>("sessionMessage")->text(); }

    std::shared_ptr<VirtualClock> m_clock;

private Q_SLOTS:
    void displayShowsImagesOnlyWhilePresenting();
    void touchReportedByTheDriverIsStamped();
    void delayedTouchReportIsDatedBack();
    void deadDriverPausesTheSessionAndLosesNothing();
    void aNoteStaysOpenWhenTheDisplayFails();
    void theRestOfASentenceDoesNothingWhenTheDisplayFails();
    void messageForADeadDriverNamesTheNextStep();
    void aLongDriverCommandFitsTheWindow();
    void driverClearsTheDisplayAfterTheProgramIsKilled();
    void plainImagesMustBeAllowed();
    void aPersonNeedsADisplayOrARehearsal();
    void noneOnTheCommandLineIsARehearsal();
    void patternOfTheChecklistEndsWithIt();
    void aScreenThatCannotBeHadIsOneError_data();
    void aScreenThatCannotBeHadIsOneError();
    void picturesNeedNoScreen();
};

void AppDisplayTest::displayShowsImagesOnlyWhilePresenting()
{
    ShownWindow shown(withReference());
    begin(shown, newStudy());
    int presented = 0;
    while (!std::holds_alternative<Finished>(shown.gui.view().state.stage)) {
        const auto* presenting = std::get_if<Presenting>(&shown.gui.view().state.stage);
        QCOMPARE(tests::displayedIn(displayFolder()) > 0, presenting != nullptr);
        presented += presenting ? 1 : 0;
        step(shown);
    }
    QVERIFY(presented > 10);
    QCOMPARE(tests::displayedIn(displayFolder()), 0);
}

void AppDisplayTest::touchReportedByTheDriverIsStamped()
{
    ShownWindow shown(withReference("--touch-after 30"));
    begin(shown, newStudy());
    stepTo<Presenting>(shown);
    const auto touched = [&] { return std::get<Presenting>(shown.gui.view().state.stage).touchedAtNs.has_value(); };
    QVERIFY(!touched());
    QTRY_VERIFY(touched());
    QVERIFY(std::get<Presenting>(shown.gui.view().state.stage).touchedBy == TouchSource::Display);
}

void AppDisplayTest::delayedTouchReportIsDatedBack()
{
    // The touch arrives while the window is busy. Meanwhile the clock of the session advances by 3 s.
    ShownWindow shown(withReference("--touch-after 30"));
    begin(shown, newStudy());
    stepTo<Presenting>(shown);
    const auto readyAt = std::get<Presenting>(shown.gui.view().state.stage).readyAtNs;
    QTest::qSleep(300);
    m_clock->advanceSeconds(3);
    const auto now = m_clock->monotonicNs();
    QTRY_VERIFY(std::get<Presenting>(shown.gui.view().state.stage).touchedAtNs);
    const auto touchedAt = *std::get<Presenting>(shown.gui.view().state.stage).touchedAtNs;
    QVERIFY(touchedAt < now - 100000000 && touchedAt > readyAt);
    // Reading the log again gives the same time.
    const auto before = shown.gui.view().state;
    const auto& plan = shown.gui.plan();
    const Event event{Touched{TouchSource::Display, now - touchedAt}, now};
    const auto copied = eventFromRecord(kindOf(event.body), payloadJson(event.body));
    QCOMPARE(std::get<Touched>(copied).agoNs, now - touchedAt);
    auto untouched = before;
    std::get<Presenting>(untouched.stage).touchedAtNs.reset();
    const auto outcome = apply(plan, untouched, {copied, now});
    QCOMPARE(std::get<Presenting>(std::get<SessionStep>(outcome).next.stage).touchedAtNs.value_or(0), touchedAt);
}

void AppDisplayTest::deadDriverPausesTheSessionAndLosesNothing()
{
    const auto study = newStudy();
    ShownWindow shown(withReference());
    begin(shown, study);
    stepTo<Presenting>(shown);
    step(shown);  // the first presentation is answered
    stepTo<Presenting>(shown);
    const int answers = shown.gui.view().state.answersStored;
    const auto trial = std::get<Presenting>(shown.gui.view().state.stage).index;
    QVERIFY(answers > 0 && tests::displayedIn(displayFolder()) > 0);

    killDriver();
    QTRY_VERIFY(shown.gui.view().state.paused);
    QVERIFY2(messageIn(shown).contains("while an image was felt") && messageIn(shown).contains("no answer is lost") &&
                 messageIn(shown).contains("press Enter"),
             qPrintable(messageIn(shown)));
    QCOMPARE(dynamic_cast<database::StudyStore&>(shown.window.study()->store()).answers().size(),
             static_cast<std::size_t>(answers));
    QCOMPARE(tests::displayedIn(displayFolder()), 0);  // the driver was restarted and shows nothing
    waitForKeys();
    shown.gui.pressKey(Qt::Key_Return);
    stepTo<Presenting>(shown);
    QCOMPARE(std::get<Presenting>(shown.gui.view().state.stage).index, trial);
    QVERIFY(tests::displayedIn(displayFolder()) > 0);
    stepTo<Finished>(shown);
    QCOMPARE(static_cast<int>(dynamic_cast<database::StudyStore&>(shown.window.study()->store()).answers().size()), 24);
    QVERIFY(dynamic_cast<database::StudyStore&>(shown.window.study()->store()).faults().empty());
}

void AppDisplayTest::aNoteStaysOpenWhenTheDisplayFails()
{
    ShownWindow shown(withReference());
    begin(shown, newStudy());
    stepTo<Presenting>(shown);
    shown.gui.pressKey(Qt::Key_N);
    shown.gui.type("a lorry ");
    killDriver();
    QTRY_VERIFY(shown.gui.view().state.paused);
    QVERIFY2(messageIn(shown).contains("while an image was felt"), qPrintable(messageIn(shown)));
    shown.gui.type("passed");
    const auto* field = qobject_cast<QPlainTextEdit*>(shown.window.focusWidget());
    QVERIFY(field && field->isVisible());
    QCOMPARE(field->toPlainText(), QString("a lorry passed"));
    shown.gui.pressKey(Qt::Key_Return);
    const auto last = shown.window.study()->store().events(ParticipantId("P01")).back();
    QCOMPARE(last.kind, std::string("noted"));
    QVERIFY2(last.payloadJson.find("a lorry passed") != std::string::npos, last.payloadJson.c_str());
    QVERIFY(shown.gui.view().state.paused && !field->isVisible());
}

/// Q would leave the session, N would open the form of a note, and Enter would go on.
void AppDisplayTest::theRestOfASentenceDoesNothingWhenTheDisplayFails()
{
    ShownWindow shown(withReference());
    begin(shown, newStudy());
    stepTo<Presenting>(shown);
    killDriver();
    QTRY_VERIFY(shown.gui.view().state.paused);
    const int sent = shown.window.session()->eventsSent();
    for (const char* typed : {"quite ", "new", "\n"}) {
        shown.gui.type(typed);
        QTest::qWait(400);  // a slow hand
    }
    QVERIFY(shown.window.session());
    QCOMPARE(shown.window.session()->eventsSent(), sent);
    QVERIFY2(messageIn(shown).contains("while an image was felt"), qPrintable(messageIn(shown)));
    waitForKeys();
    shown.gui.pressKey(Qt::Key_Return);
    QVERIFY(!shown.gui.view().state.paused);
}

void AppDisplayTest::messageForADeadDriverNamesTheNextStep()
{
    const QString works = filePath("works");
    QFile mark(works);
    QVERIFY(mark.open(QIODevice::WriteOnly));
    const QString command =
        QStringLiteral("test -e '%1' && exec " VIS2HAP_REFERENCE_DISPLAY " '%2'; echo no amplifier >&2; exit 4")
            .arg(works, displayFolder());
    ShownWindow shown(with("exec:" + command));
    begin(shown, newStudy());
    stepTo<PlacingTray>(shown);
    const int before = shown.gui.view().state.answersStored;
    mark.remove();
    QProcess list;
    list.start("ps", {"-eo", "pid,args"});
    QVERIFY(list.waitForFinished());
    for (const QString& line : QString::fromUtf8(list.readAllStandardOutput()).split('\n'))
        if (line.contains("vis2hap-reference-display " + displayFolder()))
            ::kill(line.trimmed().section(' ', 0, 0).toInt(), SIGKILL);
    QTest::qWait(50);
    QVERIFY(!shown.gui.view().state.paused);  // no image was displayed, so there is no fault to report yet
    shown.window.session()->send(TrayReady{});
    QVERIFY(shown.gui.view().state.paused);
    const QString message = messageIn(shown);
    QVERIFY2(message.contains("exit code 4; its error text: no amplifier") && message.contains("tried 3 times") &&
                 message.contains("press Enter"),
             qPrintable(message));
    QCOMPARE(shown.gui.view().state.answersStored, before);

    QVERIFY(mark.open(QIODevice::WriteOnly));  // the driver works again
    shown.gui.pressKey(Qt::Key_Return);
    QVERIFY(!shown.gui.view().state.paused);
    stepTo<Presenting>(shown);
    QVERIFY(tests::displayedIn(displayFolder()) > 0);
}

void AppDisplayTest::aLongDriverCommandFitsTheWindow()
{
    // The shell ignores these options, which look like those of a lab.
    const QString options =
        QStringLiteral("# --device /dev/serial/by-id/usb-FTDI_FT232R_USB_UART_A10K5HWZ-if00-port0 ").repeated(2) +
        QStringLiteral("--log /home/lab/driver.log");
    ShownWindow shown(withReference(options));
    shown.window.resize(1100, 750);
    begin(shown, newStudy());
    stepTo<Presenting>(shown);
    QTest::qWait(50);
    QCOMPARE(shown.window.width(), 1100);
    const auto& fact = shown.widget<QLabel>("displayFact");
    QCOMPARE(fact.text(), QString("Display on: reference display"));
    QVERIFY2(fact.toolTip().contains("/home/lab/driver.log"), qPrintable(fact.toolTip()));
    killDriver();
    QTRY_VERIFY(shown.gui.view().state.paused);
    QTest::qWait(50);
    QCOMPARE(shown.window.width(), 1100);
    QVERIFY2(messageIn(shown).contains("while an image was felt") && !messageIn(shown).contains("driver.log"),
             qPrintable(messageIn(shown)));
    for (const auto* area : shown.window.currentPage()->findChildren<QScrollArea*>())
        QVERIFY2(!area->isVisible() || area->horizontalScrollBar()->maximum() == 0, qPrintable(area->objectName()));
}

void AppDisplayTest::driverClearsTheDisplayAfterTheProgramIsKilled()
{
    // A child process opens the display, shows an image and is killed. The driver then sees the end of its input.
    QProcess child;
    child.start(QCoreApplication::applicationFilePath(),
                {"--show-and-wait", "exec:" VIS2HAP_REFERENCE_DISPLAY " '" + displayFolder() + "'"});
    QVERIFY(child.waitForReadyRead(10000));
    QCOMPARE(child.readLine(), QByteArray("shown\n"));
    QVERIFY(tests::displayedIn(displayFolder()) > 0);
    child.kill();
    QVERIFY(child.waitForFinished());
    QTRY_COMPARE(tests::displayedIn(displayFolder()), 0);
}

void AppDisplayTest::aPersonNeedsADisplayOrARehearsal()
{
    ShownWindow shown;
    const auto folder = newStudy();
    shown.window.openStudy(folder.folder);
    shown.gui.click("enrolButton");
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("displayPage"));
    QVERIFY(!shown.window.session());
    QVERIFY(shown.widget<QLabel>("displayMessage").text().startsWith("No display is connected, so P01 would feel nothing."));
    QVERIFY(shown.window.study()->store().enrolments().empty());
    shown.gui.pressKey(Qt::Key_Escape);  // goes back without a session
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("studyPage"));
    shown.gui.click("enrolButton");
    shown.gui.click("rehearseButton");
    QVERIFY(shown.window.session());
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("sessionPage"));
    QCOMPARE(shown.widget<QLabel>("displayFact").text(), QStringLiteral("NO DISPLAY: rehearsal"));
    shown.window.close();
    ShownWindow another;  // needs the act again
    another.window.openStudy(newStudy().folder);
    another.gui.click("enrolButton");
    QVERIFY(!another.window.session());
}

void AppDisplayTest::noneOnTheCommandLineIsARehearsal()
{
    AppOptions options;
    options.isDisplayGiven = true;
    ShownWindow shown(options);
    shown.window.openStudy(newStudy().folder);
    shown.gui.click("enrolButton");
    QVERIFY(shown.window.session());
}

void AppDisplayTest::patternOfTheChecklistEndsWithIt()
{
    ShownWindow shown(withReference());
    shown.window.openStudy(newStudy(tests::support::wholeStudy()).folder);
    shown.window.startSession(protocols::ParticipantId("P01"));
    stepTo<CheckingList>(shown);
    shown.gui.click("pattern1Button");
    QCOMPARE(tests::displayedIn(displayFolder()), 255);
    QVERIFY(shown.widget<QLabel>("displayFact").text().startsWith("Display on: uniform"));
    shown.gui.pressKey(Qt::Key_P);
    QCOMPARE(tests::displayedIn(displayFolder()), 0);
    QVERIFY2(shown.widget<QLabel>("displayFact").text().startsWith("Display off: "),
             qPrintable(shown.widget<QLabel>("displayFact").text()));
    shown.gui.pressKey(Qt::Key_Return);
    shown.gui.click("pattern1Button");
    QCOMPARE(tests::displayedIn(displayFolder()), 255);
    stepTo<PlacingTray>(shown);
    QCOMPARE(tests::displayedIn(displayFolder()), 0);
}

void AppDisplayTest::plainImagesMustBeAllowed()
{
    const auto refused = support::runProgram({"--display", "folder:" + displayFolder()});
    QCOMPARE(refused.exitCode, 2);
    QVERIFY2(refused.err.contains("--plain-images"), qPrintable(refused.err));
    const auto allowed = support::runProgram({"no such study", "--display", "folder:" + displayFolder(), "--plain-images"});
    QVERIFY2(!allowed.err.contains("plain"), qPrintable(allowed.err));
}

void AppDisplayTest::aScreenThatCannotBeHadIsOneError_data()
{
    QTest::addColumn<QStringList>("environment");
    QTest::newRow("nothing named") << QStringList{};
    QTest::newRow("a desktop that does not run") << QStringList{"DISPLAY=:987"};
    QTest::newRow("Wayland alone, without a compositor") << QStringList{"WAYLAND_DISPLAY=wayland-987"};
    QTest::newRow("two desktops that do not run") << QStringList{"WAYLAND_DISPLAY=wayland-987", "DISPLAY=:987"};
    QTest::newRow("Wayland asked for") << QStringList{"QT_QPA_PLATFORM=wayland"};
    QTest::newRow("unknown platform") << QStringList{"QT_QPA_PLATFORM=nowhere"};
}

void AppDisplayTest::aScreenThatCannotBeHadIsOneError()
{
    QFETCH(QStringList, environment);
    const auto ended = support::runProgram({}, environment);
    QCOMPARE(ended.exitCode, 3);
    const QStringList lines = ended.err.split('\n', Qt::SkipEmptyParts);
    QVERIFY2(lines.size() == 1 && lines.front().contains("the window needs a screen"), qPrintable(ended.err));
    for (const QString& named : environment) QVERIFY2(lines.front().contains(named), qPrintable(ended.err));
}

void AppDisplayTest::picturesNeedNoScreen()
{
    const QTemporaryDir folder;
    QImage grey(64, 64, QImage::Format_Grayscale8);
    grey.fill(90);
    QVERIFY(grey.save(folder.filePath("grey.png")));
    const auto ended = support::runProgram({"view", folder.filePath("grey.png"), "--out", folder.filePath("seen.png")},
                                           {"DISPLAY=:987", "WAYLAND_DISPLAY=wayland-987"});
    QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
    QVERIFY(QFile::exists(folder.filePath("seen.png")));
}

int main(int argc, char** argv)
{
    if (argc == 3 && QByteArray(argv[1]) == "--show-and-wait") {
        const auto display = rendering::openDisplay(argv[2]);
        display->show(cv::Mat(8, 8, CV_8UC1, cv::Scalar(99)));
        std::puts("shown");
        std::fflush(stdout);
        while (true) ::pause();
    }
    QApplication application(argc, argv);
    AppDisplayTest test;
    return QTest::qExec(&test, argc, argv);
}
#include "app_display_test.moc"
