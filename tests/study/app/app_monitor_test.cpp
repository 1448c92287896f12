// Live monitor of the principal investigator: stages, missing answers and flags while a session runs in another window. The
// monitor must stay blinded.
#include <QLabel>
#include <QScreen>
#include <QTest>
#include <QThread>
#include <QTreeWidget>

#include "protocols/files/errors.h"
#include "study/app/pages/monitor_window.h"
#include "tests/support/played_session.h"
#include "tests/support/typed_answers.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;
using namespace study::session;
using namespace tests::support;
using protocols::ParticipantId;

class AppMonitorTest : public tests::support::WindowTest {
    Q_OBJECT

private:
    /// Texts of the cells of a row, joined by "|".
    static QString rowOf(const MonitorWindow& monitor, int row)
    {
        const auto& tree = *monitor.findChild<QTreeWidget*>("monitorRows");
        QStringList cells;
        for (int column = 0; column < tree.columnCount(); ++column) cells << tree.topLevelItem(row)->text(column);
        return cells.join('|');
    }

private Q_SLOTS:
    void followsASessionInAnotherWindow();
    void voidedAnswersAreMissingUntilTheyAreRepeated();
    void placeOfAWithdrawnParticipantIsFree();
    void severalMonitorsRunBesideAWriter();
    void updatesByItself();
    void flagsAreReadOnAWorkerThread();
    void monitorShowsWhyFlagsCannotBeRead();
    void folderThatIsNoStudyIsRefused();
    void showsNoHiddenNameAndNoScore();
    void erasedParticipantsHaveNoStage();
    void aStudyInAFolderHasNoStations();
    void startsOnTheScreen();
    void largerTextWorksInAMonitorAlone();
};

void AppMonitorTest::largerTextWorksInAMonitorAlone()
{
    qApp->setProperty("vis2hapMainWindow", QVariant());  // as in `vis2hap --monitor`: no main window has been there
    MonitorWindow monitor(newStudy(wholeStudy()).folder, {});
    monitor.show();
    QTest::qWait(50);
    const double before = QApplication::font().pointSizeF();
    QTest::keyClick(&monitor, Qt::Key_Equal, Qt::ControlModifier);
    QVERIFY(QApplication::font().pointSizeF() > before);
    QTest::keyClick(&monitor, Qt::Key_0, Qt::ControlModifier);
    QCOMPARE(QApplication::font().pointSizeF(), before);
}

void AppMonitorTest::startsOnTheScreen()
{
    MonitorWindow monitor(newStudy(wholeStudy()).folder, {});
    monitor.show();
    QTest::qWait(50);
    const QRect room = monitor.screen()->availableGeometry();  // 800 x 800 without a real screen
    QVERIFY2(room.contains(monitor.frameGeometry()), qPrintable(QStringLiteral("width %1").arg(monitor.width())));
}

void AppMonitorTest::followsASessionInAnotherWindow()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    AppOptions options;
    options.clock = std::shared_ptr<Clock>(std::shared_ptr<Clock>(), &open.clock());  // shares the clock of the session
    MonitorWindow monitor(folder.folder, options);
    QCOMPARE(rowOf(monitor, 0), QString("1|–|free|||||"));
    open.window().startSession(ParticipantId("P01"));
    monitor.refresh();
    QCOMPARE(rowOf(monitor, 0), QString("1|P01|welcome|1/30|0/42|||just now"));
    open.playTo("CheckingList");
    open.clock().advanceSeconds(7 * 60);
    monitor.refresh();
    QCOMPARE(rowOf(monitor, 0), QString("1|P01|checklist|1/30|0/42|||7 min ago"));
    open.playTo("Presenting", "S1");
    monitor.refresh();
    QCOMPARE(rowOf(monitor, 0), QString("1|P01|question S1|7/30|12/42|||just now"));
    QVERIFY(monitor.findChild<QLabel*>("monitorSummary")->text().startsWith("12 of 126 answers"));
    open.perform(Paused{});
    monitor.refresh();
    QCOMPARE(rowOf(monitor, 0), QString("1|P01|paused (tray)|7/30|12/42|||just now"));
    open.perform(Resumed{});
    open.playToEnd();
    monitor.refresh();
    QCOMPARE(rowOf(monitor, 0), QString("1|P01|finished||42/42|||just now"));
}

void AppMonitorTest::voidedAnswersAreMissingUntilTheyAreRepeated()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    MonitorWindow monitor(folder.folder, {});
    open.enrolAndBegin();
    open.playTo("Presenting", "W1");
    open.perform(Voided{"the wrong piece"});
    monitor.refresh();
    QVERIFY2(rowOf(monitor, 0).startsWith("1|P01|tray|2/31|0/42|2|1|"), qPrintable(rowOf(monitor, 0)));
    open.playToEnd();
    monitor.refresh();
    QVERIFY2(rowOf(monitor, 0).startsWith("1|P01|finished||42/42||1|"), qPrintable(rowOf(monitor, 0)));
}

void AppMonitorTest::placeOfAWithdrawnParticipantIsFree()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "W1");
    open.perform(WithdrawnEvent{"tired"});
    MonitorWindow monitor(folder.folder, {});
    QVERIFY2(rowOf(monitor, 0).startsWith("1|P01|withdrawn||1/42|"), qPrintable(rowOf(monitor, 0)));
    QCOMPARE(rowOf(monitor, 1), QString("1|–|free|||||"));
    QVERIFY(monitor.findChild<QLabel*>("monitorSummary")->text().startsWith("0 of 126 answers"));
}

void AppMonitorTest::severalMonitorsRunBesideAWriter()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    MonitorWindow first(folder.folder, {}), second(folder.folder, {});
    open.enrolAndBegin();
    open.playTo("OnBreak");
    first.refresh();
    second.refresh();
    QVERIFY(rowOf(first, 0).startsWith("1|P01|break|"));
    QCOMPARE(rowOf(first, 0), rowOf(second, 0));
    open.playToEnd();
    QCOMPARE(static_cast<int>(answersIn(folder).size()), answersOf({}));
}

void AppMonitorTest::updatesByItself()
{
    const auto folder = newStudy(wholeStudy());
    MonitorWindow monitor(folder.folder, {});
    monitor.show();
    OpenSession session(folder, "P01", database::ParticipantKind::Human);
    session.stepUntil("PlacingTray");
    QTRY_VERIFY_WITH_TIMEOUT(rowOf(monitor, 0).startsWith("1|P01|tray|"), 5000);
}

void AppMonitorTest::flagsAreReadOnAWorkerThread()
{
    const auto folder = newStudy(wholeStudy());
    QThread* thread = nullptr;
    int readings = 0;
    AppOptions options;
    options.readFlags = [&](const database::StudyStore& store) {
        thread = QThread::currentThread();
        ++readings;
        return std::vector<MonitorFlag>{
            {"P01", "too_fast", std::to_string(store.answers().size()) + " answers came within half a second"},
            {"", "slot_bias", "slot A was chosen more often than chance allows"}};
    };
    MonitorWindow monitor(folder.folder, options);
    const auto* flags = monitor.findChild<QLabel*>("flags");
    QTRY_COMPARE(flags->text(), QString("P01, too fast: 0 answers came within half a second\n"
                                        "slot bias: slot A was chosen more often than chance allows"));
    QVERIFY(thread != QThread::currentThread());
    monitor.refresh();
    QTest::qWait(20);
    QCOMPARE(readings, 1);  // no new answer since the last reading
    {
        OpenSession session(folder, "P01", database::ParticipantKind::Human);
        session.playUntilAnswers(3);
    }
    monitor.refresh();
    QTRY_VERIFY(flags->text().startsWith("P01, too fast: 3 answers"));
}

void AppMonitorTest::monitorShowsWhyFlagsCannotBeRead()
{
    AppOptions options;
    options.readFlags = [](const database::StudyStore&) -> std::vector<MonitorFlag> {
        throw protocols::workFailed({.what = "the station key was altered", .where = {}, .expected = {}, .nextStep = {}});
    };
    MonitorWindow monitor(newStudy(wholeStudy()).folder, options);
    QTRY_COMPARE(monitor.findChild<QLabel*>("flags")->text(), QString("the station key was altered"));
}

void AppMonitorTest::folderThatIsNoStudyIsRefused()
{
    QVERIFY_EXCEPTION_THROWN(MonitorWindow(filePath("nothing").toStdString(), {}), protocols::Error);
}

void AppMonitorTest::showsNoHiddenNameAndNoScore()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "L1");
    MonitorWindow monitor(folder.folder, {});
    std::set<QString> hidden{"v_grey", "h&f", "h+f"};
    for (const auto& [code, hash] : dynamic_cast<database::StudyStore&>(open.window().study()->store()).stimulusHashes())
        hidden.insert(QString::fromStdString(code.value));
    for (const auto& answer : storedIn(folder)) {
        if (answer.record.answer && answer.record.question.value != "S1")
            hidden.insert(QString::fromStdString(*answer.record.answer));
    }
    const auto leaks = textsNaming(hidden, textsIn(monitor));
    QVERIFY2(leaks.empty(), leaks.empty() ? "" : qPrintable(leaks.front()));
    for (const QString& text : textsIn(monitor))
        for (const char* score : {"correct", "mean", "proportion", "rating"}) QVERIFY2(!text.contains(score), qPrintable(text));
}

void AppMonitorTest::erasedParticipantsHaveNoStage()
{
    const auto folder = newStudy(wholeStudy());
    {
        OpenSession session(folder, "P01", database::ParticipantKind::Human);
        session.playUntilAnswers(3);
        session.store.erase({ParticipantId("P01"), true, "somebody", "asked for", {}});
    }
    MonitorWindow monitor(folder.folder, {});
    QVERIFY2(rowOf(monitor, 0).startsWith("1|P01|erased|"), qPrintable(rowOf(monitor, 0)));
}

void AppMonitorTest::aStudyInAFolderHasNoStations()
{
    MonitorWindow monitor(newStudy().folder, {});
    monitor.show();
    QVERIFY(monitor.findChild<QTreeWidget*>("monitorRows")->isVisible());
    QVERIFY(!monitor.findChild<QTreeWidget*>("stationRows")->isVisible());
    const QString foot = monitor.findChild<QLabel*>("monitorHint")->text();
    QVERIFY2(foot.contains("Missing: answers") && foot.endsWith(QStringLiteral("Close:\u00A0Esc")), qPrintable(foot));
    QVERIFY(!monitor.findChild<QLabel*>("stationsCaption")->isVisible());
}

QTEST_MAIN(AppMonitorTest)
#include "app_monitor_test.moc"
