// Faults around a session: an edited protocol, a study open elsewhere, an altered stimulus, a full disk, a display that
// cannot be opened. Each must appear on its page with the next step and lose no answer.
#include <unistd.h>

#include <QFile>
#include <QGuiApplication>
#include <QLabel>
#include <QLineEdit>
#include <QTest>
#include <filesystem>
#include <utility>

#include "protocols/files/errors.h"
#include "tests/support/counting_vfs.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/typed_answers.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;
using namespace study::session;
using namespace tests::support;
using protocols::ParticipantId;
using protocols::Tenths;

namespace {

/// Clock whose wall time can be set back while its monotonic time continues.
class SteppedClock final : public Clock {
public:
    std::int64_t monotonicNs() const override { return m_monotonic.monotonicNs(); }
    std::string wallTime() const override { return m_wall.wallTime(); }
    void advanceSeconds(double seconds)
    {
        m_monotonic.advanceSeconds(seconds);
        m_wall.advanceSeconds(seconds);
    }
    void setWallBackHours(double hours) { m_wall.advanceSeconds(-3600 * hours); }

private:
    VirtualClock m_monotonic, m_wall;
};

/// Pauses in a question. The pause is stored; what is read after it fails.
void pauseBeforeReadsFail(OpenWindow& open, CountingVfs& disk)
{
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    disk.letReadsFailAfterNextSync();
    open.perform(Paused{});
}

}  // namespace

class AppFaultsTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void studyPageShowsThatTheProtocolWasEdited();
    void studyPageChecksTheProtocolBeforeEachSession();
    void messageForALockedStudyNamesTheProcess();
    void alteredStimulusIsToldBeforeTheSession();
    void fullDiskKeepsTheEntryUntilSpaceIsFree_data();
    void fullDiskKeepsTheEntryUntilSpaceIsFree();
    void logThatCannotBeReadEndsNoPause();
    void filesThatVanishInAPauseAreToldOnTheWayBack();
    void rehearsalPageTellsWhatIsTrueAfterAFault();
    void studyPageShowsWhyItsProgressCannotBeRead();
    void studyPageShowsWhyTheDisplayCannotBeOpened();
    void theOnlyScreenIsNotCovered();
    void messageOfOneSessionIsNotShownInTheNext();
    void steppedWallClockChangesNoResponseTime();
};

void AppFaultsTest::studyPageShowsThatTheProtocolWasEdited()
{
    const auto folder = newStudy(wholeStudy());
    QFile file(QString::fromStdString(folder.protocol().string()));
    QVERIFY(file.open(QIODevice::Append));
    file.write("\n");
    file.close();
    OpenWindow open(folder);
    const auto message = [&] { return open.message("studyMessage"); };
    QVERIFY2(message().contains("protocol was changed") && message().contains("study amend"), qPrintable(message()));
    QVERIFY2(message().contains("First close the study"), qPrintable(message()));
    open.gui().click("enrolButton");
    QVERIFY(!open.window().session());
    QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    QVERIFY(message().contains("protocol was changed"));
    QVERIFY(open.window().study()->store().enrolments().empty());
}

void AppFaultsTest::studyPageChecksTheProtocolBeforeEachSession()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    QVERIFY(open.message("studyMessage").isEmpty());
    QVERIFY(QFile::remove(QString::fromStdString(folder.protocol().string())));
    open.gui().click("enrolButton");
    QVERIFY(!open.window().session());
    QVERIFY2(open.message("studyMessage").contains("protocol cannot be read"), qPrintable(open.message("studyMessage")));
}

void AppFaultsTest::messageForALockedStudyNamesTheProcess()
{
    const auto folder = newStudy(wholeStudy());
    const database::StudyStore other(folder, database::StudyStore::Access::Write);
    ShownWindow shown;
    shown.widget<QLineEdit>("studyFolderField").setText(QString::fromStdString(folder.folder.string()));
    shown.gui.click("openButton");
    const auto* message = &shown.widget<QLabel>("startMessage");
    QVERIFY(message->isVisible());
    QVERIFY2(message->text().contains(QString::number(::getpid())), qPrintable(message->text()));
}

void AppFaultsTest::alteredStimulusIsToldBeforeTheSession()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    for (const auto& file : std::filesystem::directory_iterator(folder.stimuli())) {
        QFile stimulus(QString::fromStdString(file.path().string()));
        QVERIFY(stimulus.open(QIODevice::Append));
        stimulus.write("x");
    }
    open.widget<QLineEdit>("participantField").setText("P01");
    open.gui().click("enrolButton");
    QVERIFY(!open.window().session());
    const QString told = open.message("studyMessage");
    QVERIFY2(told.contains("stimulus was altered") && told.contains(".sealed") && told.contains("backup"), qPrintable(told));
    QVERIFY(database::StudyStore(folder, database::StudyStore::Access::Read).enrolments().empty());
}

void AppFaultsTest::fullDiskKeepsTheEntryUntilSpaceIsFree_data()
{
    QTest::addColumn<QString>("question");
    for (const char* question : {"Q1", "W1", "S1", "Q2"}) QTest::newRow(question) << question;
}

void AppFaultsTest::fullDiskKeepsTheEntryUntilSpaceIsFree()
{
    QFETCH(QString, question);
    const auto folder = newStudy(wholeStudy());
    CountingVfs disk;
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", question.toStdString());
    const std::string asked = nowAsked(open);
    const GivenAnswer spoken = responseTo(open.view());
    disk.letWritesFailWith(SQLITE_FULL);
    enterByKeys(open, spoken);
    pressKey(open, Qt::Key_Return);
    QVERIFY2(open.message().contains("disk is full"), qPrintable(open.message()));
    QVERIFY2(open.message().contains("not stored"), qPrintable(open.message()));
    QVERIFY(!open.view().state.paused);
    QVERIFY(!answersIn(folder).contains(asked));
    disk.letWritesFailWith(SQLITE_OK);
    pressKey(open, Qt::Key_Return);  // the entry is still in the field
    QVERIFY2(open.message().isEmpty(), qPrintable(open.message()));
    QCOMPARE(answersIn(folder).at(asked), answerText(spoken));
}

/// In a pause the page shows the head of the log, which is read after each entry.
void AppFaultsTest::logThatCannotBeReadEndsNoPause()
{
    CountingVfs disk;
    OpenWindow open(newStudy(wholeStudy()));
    pauseBeforeReadsFail(open, disk);
    QVERIFY(open.view().state.paused);
    const QString message = open.message();
    QVERIFY2(message.contains("last entry was stored") && message.contains("disk reported an error"), qPrintable(message));
    QVERIFY_EXCEPTION_THROWN(open.perform(Resumed{}), protocols::Error);
    QVERIFY2(open.message().contains("session is paused and no answer is lost"), qPrintable(open.message()));
    disk.letReadsWork();
    open.perform(Resumed{});
    QVERIFY2(open.message().isEmpty(), qPrintable(open.message()));
    QVERIFY(!open.view().state.paused);
    open.playTo("Presenting", "Q1");
}

/// The operator looks at the page of the headphones meanwhile. The message has the name of the rescue file, and comes once.
void AppFaultsTest::filesThatVanishInAPauseAreToldOnTheWayBack()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    open.perform(Paused{});
    QVERIFY2(open.message().isEmpty(), qPrintable(open.message()));
    std::filesystem::rename(folder.database(), folder.folder / "elsewhere.db");
    open.gui().pressKey(Qt::Key_F4);
    QCOMPARE(open.window().currentPage()->objectName(), QString("participantPage"));
    open.gui().pressKey(Qt::Key_F4);
    QCOMPARE(open.window().currentPage()->objectName(), QString("sessionPage"));
    QVERIFY2(open.message().contains("every stored answer is kept in"), qPrintable(open.message()));
    QVERIFY(open.view().state.paused);
}

/// The study cannot be read while the display is connected. "Check again" finds it mended.
void AppFaultsTest::rehearsalPageTellsWhatIsTrueAfterAFault()
{
    CountingVfs disk;
    const auto folder = newStudy(wholeStudy()), another = newStudy();
    bool fails = true;
    AppOptions options;
    options.makeRehearsal = [](const std::filesystem::path&) { return std::shared_ptr<const std::filesystem::path>(); };
    options.openDisplay = [&](const std::string&, const std::stop_token&) {
        if (std::exchange(fails, false)) {
            disk.letReadsFailAfterNextSync();
            RawSqlite(another.database()).run("CREATE TABLE synced(x)");
        }
        return std::make_unique<FakeDisplay>();
    };
    ShownWindow shown(options);
    shown.window.openStudy(folder.folder);
    shown.gui.pressKey(Qt::Key_F8);
    QCOMPARE(shown.window.currentPage()->objectName(), QString("rehearsalPage"));
    const auto text = [&](const char* name) { return shown.widget<QLabel>(name).text(); };
    QVERIFY2(text("rehearsalMessage").contains("disk reported an error"), qPrintable(text("rehearsalMessage")));
    QVERIFY2(text("rehearsalDisplay").contains("fake is connected"), qPrintable(text("rehearsalDisplay")));
    QVERIFY2(!text("rehearsalComputer").contains("clock is in order"), qPrintable(text("rehearsalComputer")));
    disk.letReadsWork();
    shown.gui.pressKey(Qt::Key_F7);
    QCOMPARE(text("rehearsalMessage"), QString());
    QVERIFY(text("rehearsalDisplay").contains("fake is connected"));
    QVERIFY2(text("rehearsalComputer").contains("clock is in order"), qPrintable(text("rehearsalComputer")));
}

void AppFaultsTest::studyPageShowsWhyItsProgressCannotBeRead()
{
    CountingVfs disk;
    OpenWindow open(newStudy(wholeStudy()));
    pauseBeforeReadsFail(open, disk);
    pressKey(open, Qt::Key_Q);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    const auto message = [&] { return open.message("studyMessage"); };
    QVERIFY2(message().contains("disk reported an error"), qPrintable(message()));
    open.gui().click("displayButton");
    open.gui().click("displayBackButton");
    QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    QVERIFY2(message().contains("disk reported an error"), qPrintable(message()));
    disk.letReadsWork();
    open.gui().click("displayButton");
    open.gui().click("displayBackButton");
    QVERIFY2(message().isEmpty(), qPrintable(message()));
    open.window().startSession(ParticipantId("P01"));
    QVERIFY(open.window().session());
}

void AppFaultsTest::studyPageShowsWhyTheDisplayCannotBeOpened()
{
    const auto folder = newStudy(wholeStudy());
    AppOptions options;
    options.display = "cover:9";
    ShownWindow shown(options);
    shown.window.openStudy(folder.folder);
    shown.gui.click("enrolButton");
    QCOMPARE(shown.window.currentPage()->objectName(), QString("studyPage"));
    const auto* message = &shown.widget<QLabel>("studyMessage");
    QVERIFY(message->isVisible());
    QVERIFY2(message->text().contains("no screen 9"), qPrintable(message->text()));
    QVERIFY(shown.window.study()->store().enrolments().empty());
}

void AppFaultsTest::theOnlyScreenIsNotCovered()
{
    if (QGuiApplication::screens().size() > 1) QSKIP("there is more than one screen");
    try {
        study::app::openDisplay("cover:0");
        QFAIL("the cover hides the console");
    } catch (const protocols::Error& fault) {
        QVERIFY2(QString::fromUtf8(fault.what()).contains("hide the console"), fault.what());
    }
}

void AppFaultsTest::messageOfOneSessionIsNotShownInTheNext()
{
    OpenWindow open(newStudy(wholeStudy()));
    open.enrolAndBegin();
    open.display().fault = "the display is gone";
    pressKey(open, Qt::Key_Return);
    QVERIFY(!open.message().isEmpty());
    open.display().fault.clear();
    pressKey(open, Qt::Key_Q);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    open.window().startSession(ParticipantId("P01"));
    QVERIFY(open.message().isEmpty());
}

void AppFaultsTest::steppedWallClockChangesNoResponseTime()
{
    const auto folder = newStudy(wholeStudy());
    const auto clock = std::make_shared<SteppedClock>();
    AppOptions options;
    options.clock = clock;
    OpenWindow open(folder, options);
    open.enrolAndBegin();
    open.playTo("Presenting", "S1");
    pressKey(open, Qt::Key_T);
    clock->advanceSeconds(2.25);
    clock->setWallBackHours(3);
    clock->advanceSeconds(2.25);
    const QString timeLeft = open.widget<QLabel>("timeLeftFact").text(), sitting = open.widget<QLabel>("sittingFact").text();
    enterByKeys(open, responseTo(open.view()));
    const std::string asked = nowAsked(open);
    pressKey(open, Qt::Key_Return);
    const auto answers = storedIn(folder);
    QCOMPARE(answers.back().record.question.value, std::string("S1"));
    QCOMPARE(answers.back().seconds, 4.5);
    QVERIFY(answers.back().storedAtNs >= answers.back().record.answeredAtNs);
    QVERIFY(answers.back().wallTime < answers.front().wallTime);  // the record keeps the wall time as it was
    QVERIFY(answersIn(folder).contains(asked));
    QCOMPARE(open.widget<QLabel>("sittingFact").text(), sitting);
    QVERIFY(timeLeft.startsWith("About"));
    open.playTo("OnBreak");
    QVERIFY(dynamic_cast<database::StudyStore&>(open.window().study()->store()).faults().empty());
}

QTEST_MAIN(AppFaultsTest)
#include "app_faults_test.moc"
