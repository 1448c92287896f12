// The rehearsal as an operator does it before the first participant comes, and what it must not touch.
#include <QLabel>
#include <QLineEdit>
#include <QTest>
#include <filesystem>
#include <map>

#include "protocols/files/sha256.h"
#include "study/app/pages/setup/rehearsal_page.h"
#include "study/app/pages/setup/room_checks.h"
#include "study/making/rehearsal.h"
#include "tests/support/open_window.h"

using namespace study::app;
using tests::support::OpenWindow;
namespace fs = std::filesystem;

namespace {

std::map<std::string, std::string> bytesIn(const fs::path& folder)
{
    std::map<std::string, std::string> hashes;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) hashes[entry.path().string()] = protocols::sha256OfFile(entry.path());
    return hashes;
}

}  // namespace

class AppRehearsalTest : public tests::support::WindowTest {
    Q_OBJECT

    /// The folder of the latest rehearsal is kept in m_last.
    AppOptions options()
    {
        AppOptions given;
        given.makeRehearsal = [this](const fs::path& study) {
            auto made = study::making::makeRehearsal(study);
            m_last = *made;
            return made;
        };
        return given;
    }
    static RehearsalPage& pageOf(OpenWindow& open) { return *qobject_cast<RehearsalPage*>(open.window().currentPage()); }
    static QString shownIn(OpenWindow& open, const char* name) { return open.widget<QLabel>(name).text(); }
    static void type(OpenWindow& open, const QString& code)
    {
        auto& line = open.widget<QLineEdit>("rehearsalPieceField");
        line.setFocus();
        QTest::keyClicks(&line, code);
        QTest::keyClick(&line, Qt::Key_Return);
    }
    static void tick(OpenWindow& open, const char* name) { QTest::keyClick(&open.widget<QWidget>(name), Qt::Key_Space); }

    fs::path m_last;

private Q_SLOTS:
    void everythingTriedIsReadyForTheFirstParticipant();
    void nothingOfItTouchesTheStudy();
    void aSessionThatWasLeftIsStillMissing();
    void whatIsMissingIsNamed();
    void theComputerIsChecked();
    void windowWithoutARehearsalShowsNoButton();
};

void AppRehearsalTest::everythingTriedIsReadyForTheFirstParticipant()
{
    OpenWindow open(newStudy(), options(), {});
    open.gui().pressKey(Qt::Key_F8);
    QCOMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    for (const char* box : {"rehearsalFelt", "rehearsalHeard", "rehearsalSheets"}) tick(open, box);
    const QStringList codes = open.window().study()->codesOnPieces();
    QVERIFY(codes.size() >= 3);
    type(open, "no such code");
    QVERIFY(open.message("rehearsalMessage").contains("is no code of this study"));
    const auto& message = open.widget<QLabel>("rehearsalMessage");
    QVERIFY(message.y() > open.widget<QLineEdit>("rehearsalPieceField").y());
    QVERIFY(message.y() < open.widget<QLabel>("rehearsalComputer").y());
    for (const QString& code : codes) type(open, code);
    QCOMPARE(shownIn(open, "rehearsalPieces"), QString("Every fabric piece is there."));
    QCOMPARE(shownIn(open, "rehearsalResult"), QString("Still missing: a session played to its end."));
    open.gui().pressKey(Qt::Key_F5);
    QCOMPARE(open.window().currentPage()->objectName(), QString("sessionPage"));
    QCOMPARE(shownIn(open, "participantFact"), QString("REHEARSAL: nothing becomes data"));
    open.playToEnd();
    open.gui().pressKey(Qt::Key_Return);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    QCOMPARE(shownIn(open, "rehearsalResult"), QString("Ready for P01."));
    QTest::keyClick(open.window().currentPage(), Qt::Key_Escape);
    QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
}

void AppRehearsalTest::nothingOfItTouchesTheStudy()
{
    const auto study = newStudy();
    OpenWindow open(study, options(), {});
    const auto before = bytesIn(study.folder);
    const auto head = database::textOf(open.window().study()->store().head());
    open.gui().pressKey(Qt::Key_F8);
    open.gui().pressKey(Qt::Key_F5);
    const auto& plan = open.gui().plan();
    QVERIFY(plan.trials.size() < open.window().study()->store().trials(1).size());
    QVERIFY(fs::exists(m_last));
    open.playToEnd();
    open.gui().pressKey(Qt::Key_Return);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    QVERIFY(!fs::exists(m_last));
    QCOMPARE(database::textOf(open.window().study()->store().head()), head);
    QVERIFY(bytesIn(study.folder) == before);
    QVERIFY(open.window().study()->store().enrolments().empty());
}

void AppRehearsalTest::aSessionThatWasLeftIsStillMissing()
{
    OpenWindow open(newStudy(), options(), {});
    open.gui().pressKey(Qt::Key_F8);
    open.gui().pressKey(Qt::Key_F5);
    open.playTo("Presenting");
    open.gui().pressKey(Qt::Key_Q);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    QVERIFY(open.message("rehearsalMessage").contains("left before its end"));
    QVERIFY(!pageOf(open).tried().sessionWasPlayed);
    QVERIFY(!fs::exists(m_last));
    // A second one begins anew.
    open.gui().pressKey(Qt::Key_F5);
    QCOMPARE(open.view().answersStored, 0);
}

void AppRehearsalTest::whatIsMissingIsNamed()
{
    AppOptions without = options();
    OpenWindow open(newStudy(), without);
    open.gui().pressKey(Qt::Key_F8);
    RehearsalState nothing;
    nothing.piecesLeft = {"663"};
    nothing.diskFault = nothing.clockFault = "fault";
    QCOMPARE(nothing.missing().size(), 7);
    nothing.displayIsThere = true;
    QVERIFY(nothing.missing().contains("a test pattern that was felt"));
    QVERIFY(!nothing.missing().contains("a display"));
    // What was ticked stays while the page of the display is visited.
    tick(open, "rehearsalHeard");
    open.gui().pressKey(Qt::Key_F6);
    QCOMPARE(open.window().currentPage()->objectName(), QString("displayPage"));
    QTest::keyClick(open.window().focusWidget(), Qt::Key_Escape);
    QCOMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    QVERIFY(pageOf(open).tried().soundWasHeard);
    QVERIFY(!shownIn(open, "rehearsalResult").contains("masking"));
}

void AppRehearsalTest::theComputerIsChecked()
{
    QCOMPARE(faultOfDisk(filePath(".").toStdString()), QString());
    QVERIFY(faultOfDisk(filePath("nowhere").toStdString()).contains("cannot be asked"));
    if (fs::exists("/proc")) QVERIFY(!faultOfDisk("/proc").isEmpty());
    QCOMPARE(faultOfClocks("2020-01-01T00:00:00.000+01:00"), QString());
    QVERIFY(faultOfClocks("2999-01-01T00:00:00.000+01:00").contains("behind the last entry"));
}

void AppRehearsalTest::windowWithoutARehearsalShowsNoButton()
{
    OpenWindow open(newStudy());
    QVERIFY(!open.window().findChild<QWidget*>("rehearsalButton")->isVisible());
}

QTEST_MAIN(AppRehearsalTest)
#include "app_rehearsal_test.moc"
