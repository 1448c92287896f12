// Connecting a display in the real window: the page of the display, sessions that wait for a driver, and drivers that fail or
// never answer. The window stays alive meanwhile.
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <QComboBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QSettings>
#include <QTest>
#include <QTimer>

#include "study/app/pages/checklist_page.h"
#include "study/app/state/tried_display.h"
#include "tests/study/app/displayed_image.h"
#include "tests/support/open_window.h"
#include "tests/support/played_session.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;
using namespace study::session;
using tests::displayedIn;
using tests::support::ShownWindow;

namespace {

/// Accepts connections, as the system does for every listener, and never answers.
struct SilentServer {
    int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    int port = 0;
    SilentServer()
    {
        sockaddr_in place{};
        socklen_t size = sizeof place;
        place.sin_family = AF_INET;
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        ::bind(listener, reinterpret_cast<sockaddr*>(&place), size);
        ::listen(listener, 8);
        ::getsockname(listener, reinterpret_cast<sockaddr*>(&place), &size);
        port = ntohs(place.sin_port);
    }
    ~SilentServer() { ::close(listener); }
    SilentServer(const SilentServer&) = delete;
    SilentServer& operator=(const SilentServer&) = delete;
};

/// Counts the turns of the event loop, and measures the longest time without one.
struct Heartbeat {
    QTimer timer;
    QElapsedTimer sinceStart, sinceBeat;
    int beats = 0;
    qint64 longestGapMs = 0;
    Heartbeat()
    {
        QObject::connect(&timer, &QTimer::timeout, &timer, [this] {
            ++beats;
            longestGapMs = std::max(longestGapMs, sinceBeat.restart());
        });
        sinceStart.start();
        sinceBeat.start();
        timer.start(10);
    }
};

/// Whether a process runs with these words in its arguments.
bool isRunning(const QString& words)
{
    QProcess list;
    list.start("ps", {"-eo", "args"});
    return !list.waitForFinished() || QString::fromUtf8(list.readAllStandardOutput()).contains(words);
}

void chooseDisplay(ShownWindow& shown, const QString& kind, const QString& argument)
{
    auto& kinds = shown.widget<QComboBox>("displayKind");
    kinds.setCurrentIndex(kinds.findData(kind));
    shown.widget<QLineEdit>("displayArgumentField").setText(argument);
}

}  // namespace

class AppConnectingTest : public tests::support::WindowTest {
    Q_OBJECT

    QString displayFolder() { return filePath(QString::fromLatin1(QTest::currentTestFunction()) + "-displayed"); }
    AppOptions with(const QString& display)
    {
        AppOptions options;
        options.display = display.toStdString();
        options.clock = m_clock = std::make_shared<VirtualClock>();
        return options;
    }
    AppOptions withReference() { return with(QStringLiteral("exec:" VIS2HAP_REFERENCE_DISPLAY " '%1'").arg(displayFolder())); }
    template <class Stage>
    void stepTo(ShownWindow& shown)
    {
        while (!std::holds_alternative<Stage>(shown.gui.view().state.stage)) {
            m_clock->advanceSeconds(1);
            const auto refusal = shown.gui.perform(*tests::support::nextEvent(shown.gui.view(), shown.gui.plan()));
            if (refusal) QFAIL(refusal->reason.c_str());
        }
    }

    std::shared_ptr<VirtualClock> m_clock;

private Q_SLOTS:
    void displayPageConnectsAndRemembers();
    void displayPageNamesTheSizeOfSessionsWhereItDiffers_data();
    void displayPageNamesTheSizeOfSessionsWhereItDiffers();
    void displayPageShowsFaultsInPlainWords_data();
    void displayPageShowsFaultsInPlainWords();
    void connectingLeavesTheWindowAliveAndCanBeStopped_data();
    void connectingLeavesTheWindowAliveAndCanBeStopped();
    void aSilentDriverIsGivenUpInTheTimeThatThePageNames();
    void aSessionWaitsForItsDisplayWithoutBlockingTheWindow();
    void aSessionBeginsWhenItsSlowDriverAnswers();
    void studyPageShowsWhyTheDriverCannotStart();
    void patternIsFeltOnlyWhileItsButtonIsDown();
    void aDisplayOfTicketsIsOfferedNoPattern();
    void aRememberedFolderIsNamedBeforeASession();
};

void AppConnectingTest::displayPageConnectsAndRemembers()
{
    AppOptions options;
    options.settings = std::make_shared<QSettings>(filePath("display.ini"), QSettings::IniFormat);
    options.clock = m_clock = std::make_shared<VirtualClock>();
    {
        ShownWindow shown(options);
        shown.gui.click("displayButton");
        QCOMPARE(shown.widget<QComboBox>("displayKind").findData(QStringLiteral("folder:")), -1);  // they were not allowed
        chooseDisplay(shown, "exec:", VIS2HAP_REFERENCE_DISPLAY " '" + displayFolder() + "'");
        shown.gui.click("connectDisplayButton");
        QTRY_VERIFY(!shown.widget<QLabel>("displayState").text().startsWith("Connecting"));
        QVERIFY2(shown.widget<QLabel>("displayState").text().startsWith("Connected: "),
                 qPrintable(shown.widget<QLabel>("displayMessage").text()));
        QVERIFY2(shown.widget<QLabel>("displayAbout").text().contains(" px  ·  "),
                 qPrintable(shown.widget<QLabel>("displayAbout").text()));
        QVERIFY(!shown.window.currentPage()->findChild<QPushButton*>("pattern4Button")->isEnabled());  // no scale yet
        QTest::keyClicks(&shown.widget<QLineEdit>("displayScaleField"), "0.17");
        QVERIFY(shown.window.currentPage()->findChild<QPushButton*>("pattern4Button")->isEnabled());
    }
    ShownWindow next(options);
    next.window.openStudy(newStudy(tests::support::wholeStudy()).folder);
    next.gui.click("enrolButton");
    QTRY_VERIFY(next.window.session());
    QVERIFY(next.widget<QLabel>("displayFact").toolTip().contains("exec:"));
    stepTo<CheckingList>(next);
    QVERIFY(next.window.currentPage()->findChild<QPushButton*>("pattern4Button")->isEnabled());
}

void AppConnectingTest::displayPageNamesTheSizeOfSessionsWhereItDiffers_data()
{
    QTest::addColumn<QString>("size");
    QTest::addColumn<bool>("isNamed");
    QTest::newRow("the same") << R"("width":1280,"height":800)" << false;
    QTest::newRow("another") << R"("width":1920,"height":1080)" << true;
}

void AppConnectingTest::displayPageNamesTheSizeOfSessionsWhereItDiffers()
{
    QFETCH(QString, size);
    QFETCH(bool, isNamed);
    ShownWindow shown;
    shown.gui.click("displayButton");
    const QString hello = R"({"type":"hello","id":1,"schema":"vis2hap.display/1","name":"A","touches":false,%1})";
    chooseDisplay(shown, "exec:",
                  "read request; echo '" + hello.arg(size) + R"('; read request; echo '{"type":"cleared","id":2}'; cat >&2)");
    shown.gui.click("connectDisplayButton");
    QTRY_VERIFY(shown.widget<QLabel>("displayState").text().startsWith("Connected: A (exec:read request"));
    const QString about = shown.widget<QLabel>("displayAbout").text();
    QVERIFY2(about.contains("sessions send 1280 × 800 px") == isNamed, qPrintable(about));
}

void AppConnectingTest::displayPageShowsFaultsInPlainWords_data()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QString>("argument");
    QTest::addColumn<QString>("words");
    QTest::newRow("wrong command") << "exec:"
                                   << "/nowhere/driver"
                                   << "exit code 127";
    QTest::newRow("no hello") << "exec:"
                              << "exit 0"
                              << "ended";
    QTest::newRow("no connection") << "tcp:"
                                   << "127.0.0.1:1"
                                   << "refused";
    QTest::newRow("no screen") << "cover:"
                               << "9"
                               << "no screen 9";
}

void AppConnectingTest::displayPageShowsFaultsInPlainWords()
{
    QFETCH(QString, kind);
    QFETCH(QString, argument);
    QFETCH(QString, words);
    ShownWindow shown;
    shown.gui.click("displayButton");
    chooseDisplay(shown, kind, argument);
    shown.gui.click("connectDisplayButton");
    QTRY_VERIFY(!shown.widget<QLabel>("displayState").text().startsWith("Connecting"));
    const QString message = shown.widget<QLabel>("displayMessage").text();
    QVERIFY2(message.contains(words), qPrintable(message));
    QCOMPARE(shown.widget<QLabel>("displayState").text(), QStringLiteral("Not connected"));
    QVERIFY(!shown.window.currentPage()->findChild<QPushButton*>("pattern1Button")->isEnabled());
}

void AppConnectingTest::connectingLeavesTheWindowAliveAndCanBeStopped_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("a program that says nothing") << "exec:";
    QTest::newRow("a computer that says nothing") << "tcp:";
}

void AppConnectingTest::connectingLeavesTheWindowAliveAndCanBeStopped()
{
    QFETCH(QString, kind);
    const SilentServer server;
    const QString program = QStringLiteral("exec sleep 61.5");
    const QString argument = kind == "exec:" ? program : QStringLiteral("127.0.0.1:%1").arg(server.port);
    ShownWindow shown;
    shown.gui.click("displayButton");
    chooseDisplay(shown, kind, argument);
    Heartbeat heart;
    shown.gui.focusOn("displayArgumentField");
    shown.gui.pressKey(Qt::Key_Return);
    QVERIFY2(heart.sinceStart.elapsed() < 400, qPrintable(QString::number(heart.sinceStart.elapsed())));
    shown.gui.pressKey(Qt::Key_Return);  // a key that bounces does not stop it
    QTest::qWait(600);
    QVERIFY2(heart.longestGapMs < 400 && heart.beats > 20,
             qPrintable(QStringLiteral("%1 beats, gap %2 ms").arg(heart.beats).arg(heart.longestGapMs)));
    const auto& state = shown.widget<QLabel>("displayState");
    QVERIFY2(state.text().startsWith("Connecting…") && state.text().contains("10 seconds"), qPrintable(state.text()));
    QVERIFY(!shown.window.currentPage()->findChild<QLineEdit*>("displayArgumentField")->isEnabled());
    shown.gui.pressKey(Qt::Key_Escape);
    QCOMPARE(state.text(), QStringLiteral("Not connected"));
    QVERIFY2(heart.longestGapMs < 700, qPrintable(QString::number(heart.longestGapMs)));
    QVERIFY(shown.widget<QLabel>("displayMessage").text().contains("stopped"));
    QVERIFY(!isRunning("sleep 61.5"));
    QCOMPARE(shown.window.focusWidget()->objectName(), QStringLiteral("displayArgumentField"));
    shown.gui.pressKey(Qt::Key_Return);  // leaves while it connects again
    shown.gui.click("connectDisplayButton");
    shown.gui.pressKey(Qt::Key_Escape);
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("startPage"));
}

void AppConnectingTest::aSilentDriverIsGivenUpInTheTimeThatThePageNames()
{
    ShownWindow shown;
    shown.gui.click("displayButton");
    chooseDisplay(shown, "exec:", "exec sleep 60");
    shown.gui.click("connectDisplayButton");
    const auto& state = shown.widget<QLabel>("displayState");
    QVERIFY(state.text().contains("10 seconds"));
    QTRY_COMPARE_WITH_TIMEOUT(state.text(), QStringLiteral("Not connected"), 10000);
    const auto& message = shown.widget<QLabel>("displayMessage");
    QVERIFY2(message.text().contains("does not answer"), qPrintable(message.text()));
    QTRY_VERIFY(message.y() >= shown.widget<QLineEdit>("displayArgumentField").geometry().bottom());
    QVERIFY(message.y() < shown.widget<QPushButton>("connectDisplayButton").y());
}

void AppConnectingTest::aSessionWaitsForItsDisplayWithoutBlockingTheWindow()
{
    ShownWindow shown(with("exec:exec sleep 62.5"));
    shown.window.openStudy(newStudy().folder);
    Heartbeat heart;
    shown.gui.click("enrolButton");
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("connectingPage"));
    shown.gui.pressKey(Qt::Key_Return);  // a key that bounces neither stops nor enrols
    QTest::qWait(400);
    QVERIFY2(heart.longestGapMs < 400 && heart.beats > 10,
             qPrintable(QStringLiteral("%1 beats, gap %2 ms").arg(heart.beats).arg(heart.longestGapMs)));
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("connectingPage"));
    shown.gui.pressKey(Qt::Key_Escape);
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("studyPage"));
    QVERIFY(shown.widget<QLabel>("studyMessage").text().contains("stopped"));
    QVERIFY(!isRunning("sleep 62.5"));
    QVERIFY(!shown.window.session());
    QVERIFY(shown.window.study()->store().enrolments().empty());
}

void AppConnectingTest::aSessionBeginsWhenItsSlowDriverAnswers()
{
    ShownWindow shown(with(QStringLiteral("exec:sleep 0.5; exec " VIS2HAP_REFERENCE_DISPLAY " '%1'").arg(displayFolder())));
    shown.window.openStudy(newStudy().folder);
    shown.gui.click("enrolButton");
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("connectingPage"));
    QTRY_VERIFY(shown.window.session());
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("sessionPage"));
    stepTo<Presenting>(shown);
    QVERIFY(displayedIn(displayFolder()) > 0);
}

void AppConnectingTest::studyPageShowsWhyTheDriverCannotStart()
{
    ShownWindow shown(with("exec:/nowhere/driver"));
    shown.window.openStudy(newStudy().folder);
    shown.gui.click("enrolButton");
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QStringLiteral("studyPage"));
    const QString message = shown.window.currentPage()->findChild<QLabel*>("studyMessage")->text();
    QVERIFY2(message.contains("exit code 127") && message.contains("not found"), qPrintable(message));
    QVERIFY(!shown.window.session());
}

/// Of `vis2hap display serve`, which refuses plain images.
void AppConnectingTest::aDisplayOfTicketsIsOfferedNoPattern()
{
    AppOptions options;
    options.display = "tcp:127.0.0.1:5417";
    options.openDisplay = [](const std::string&, const std::stop_token&) {
        auto display = std::make_unique<tests::support::FakeDisplay>();
        display->isFetching = true;
        return display;
    };
    ShownWindow shown(options);
    shown.gui.click("displayButton");
    shown.gui.click("connectDisplayButton");
    QTRY_VERIFY(shown.widget<QLabel>("displayState").text().startsWith("Connected"));
    QVERIFY(!shown.window.currentPage()->findChild<QPushButton*>("pattern1Button")->isEnabled());
    QVERIFY(shown.widget<QLabel>("displayAbout").text().contains("no test patterns"));
    for (const bool takesTickets : {false, true}) {
        ChecklistPage list(nullptr);
        SessionFacts facts;
        facts.displayName = "glass";
        facts.displayTakesTickets = takesTickets;
        list.begin(facts);
        QCOMPARE(list.findChild<QPushButton*>("pattern1Button")->isVisibleTo(&list), !takesTickets);
        QCOMPARE(list.findChild<QLabel*>("patternsCaption")->text().contains("no test patterns"), takesTickets);
    }
}

void AppConnectingTest::patternIsFeltOnlyWhileItsButtonIsDown()
{
    ShownWindow shown(withReference());
    shown.gui.click("displayButton");
    shown.gui.click("connectDisplayButton");
    QTRY_VERIFY(shown.widget<QLabel>("displayState").text().startsWith("Connected"));
    QCOMPARE(displayedIn(displayFolder()), 0);
    shown.gui.click("pattern1Button");
    QCOMPARE(displayedIn(displayFolder()), 255);
    QCOMPARE(shown.widget<QLabel>("patternShown").text(), QStringLiteral("On: uniform"));
    shown.gui.click("pattern2Button");
    QCOMPARE(displayedIn(displayFolder()), -1);  // an edge is not uniform
    QVERIFY(!shown.window.currentPage()->findChild<QPushButton*>("pattern1Button")->isChecked());
    shown.gui.click("pattern2Button");
    QCOMPARE(displayedIn(displayFolder()), 0);
    shown.gui.click("pattern1Button");
    QCOMPARE(displayedIn(displayFolder()), 255);
    shown.gui.pressKey(Qt::Key_Escape);
    QCOMPARE(displayedIn(displayFolder()), 0);
    QCOMPARE(shown.window.currentPage()->objectName(), QStringLiteral("startPage"));
}

void AppConnectingTest::aRememberedFolderIsNamedBeforeASession()
{
    AppOptions options;
    options.settings = std::make_shared<QSettings>(filePath("folder.ini"), QSettings::IniFormat);
    study::app::rememberDisplay(options.settings.get(), "folder:/run/display");
    const auto message = [](ShownWindow& shown) { return shown.widget<QLabel>("startMessage").text(); };
    ShownWindow refused(options);
    QVERIFY2(message(refused).contains("folder:/run/display") && message(refused).contains("--plain-images"),
             qPrintable(message(refused)));
    options.allowsPlainImages = true;
    ShownWindow allowed(options);
    QVERIFY2(message(allowed).isEmpty(), qPrintable(message(allowed)));
}

QTEST_MAIN(AppConnectingTest)
#include "app_connecting_test.moc"
