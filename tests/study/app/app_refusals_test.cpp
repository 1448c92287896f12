// What the window refuses: voids without a reason, keys that bounced or were held down, keys at the wrong moment. It says so,
// where the operator sees it.
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTest>

#include "study/app/language/language.h"
#include "study/app/pages/session_page.h"
#include "study/app/pieces/pieces.h"
#include "study/session/session_record.h"
#include "tests/study/app/page_measures.h"
#include "tests/support/counting_vfs.h"
#include "tests/support/typed_answers.h"

using namespace study::app;
using namespace study::session;
using namespace tests::support;

namespace {

constexpr double bounceSeconds = 0.06, deadTimeSeconds = 0.7;

int voidsIn(OpenWindow& open)
{
    int voids = 0;
    for (const auto& record : open.window().study()->store().events(protocols::ParticipantId("P01")))
        voids += record.kind == kindOf(Voided{}) ? 1 : 0;
    return voids;
}

QString reasonIn(OpenWindow& open) { return open.widget<QPlainTextEdit>("reasonField").toPlainText(); }

/// A press as a keyboard sends it, with its time.
void pressAt(OpenWindow& open, int key, const QString& text, ulong atMs)
{
    QKeyEvent press(QEvent::KeyPress, key, Qt::NoModifier, text);
    press.setTimestamp(atMs);
    QApplication::sendEvent(open.window().focusWidget(), &press);
}

void releaseAt(OpenWindow& open, int key, const QString& text, ulong atMs)
{
    QKeyEvent release(QEvent::KeyRelease, key, Qt::NoModifier, text);
    release.setTimestamp(atMs);
    QApplication::sendEvent(open.window().focusWidget(), &release);
}

void chooseReason(OpenWindow& open, Qt::Key digit) { QTest::keyClick(open.window().focusWidget(), digit, Qt::AltModifier); }

}  // namespace

class AppRefusalsTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void aVoidAlwaysHasAReason()
    {
        OpenWindow open(newStudy());
        open.enrolAndBegin();
        open.playTo("Presenting", "Q1");
        pressKey(open, Qt::Key_V);
        for (int press = 0; press < 3; ++press) {
            open.clock().advanceSeconds(2);
            pressKey(open, Qt::Key_Return);
            QVERIFY2(open.message().contains("Alt 1 to Alt 4"), qPrintable(open.message()));
        }
        typeText(open, "  ");
        pressKey(open, Qt::Key_Return);
        QCOMPARE(voidsIn(open), 0);
        chooseReason(open, Qt::Key_3);
        QCOMPARE(reasonIn(open), QString("Fault of the display"));
        chooseReason(open, Qt::Key_1);
        QCOMPARE(reasonIn(open), QString("Wrong piece on the tray"));
        typeText(open, ": 663");  // the reason can be completed
        QCOMPARE(voidsIn(open), 0);
        pressKey(open, Qt::Key_Return);
        QCOMPARE(voidsIn(open), 1);
        const auto events = open.window().study()->store().events(protocols::ParticipantId("P01"));
        const std::string& stored = events.back().payloadJson;
        QVERIFY2(stored.find("Wrong piece on the tray: 663") != std::string::npos, stored.c_str());
    }

    /// Scripts and logs of earlier versions hold such voids.
    void aScriptVoidsWithoutAReason()
    {
        OpenWindow open(newStudy());
        open.enrolAndBegin();
        open.playTo("Presenting", "Q1");
        open.perform(Voided{""});
        QCOMPARE(voidsIn(open), 1);
        open.perform(open.nextEvent());
    }

    void usualReasonsBelongToVoids()
    {
        OpenWindow open(newStudy());
        open.enrolAndBegin();
        pressKey(open, Qt::Key_N);
        chooseReason(open, Qt::Key_1);
        QCOMPARE(reasonIn(open), QString());
    }

    void theKeyThatOpensAPanelWritesNothing_data()
    {
        QTest::addColumn<int>("key");
        QTest::addColumn<QString>("letter");
        QTest::newRow("void") << int(Qt::Key_V) << "v";
        QTest::newRow("note") << int(Qt::Key_N) << "n";
        QTest::newRow("flag") << int(Qt::Key_F) << "f";
    }
    void theKeyThatOpensAPanelWritesNothing()
    {
        QFETCH(int, key);
        QFETCH(QString, letter);
        OpenWindow open(newStudy());
        open.enrolAndBegin();
        open.playTo("Presenting", "Q1");
        ulong atMs = 7000000;
        pressAt(open, key, letter, atMs);
        for (int repeat = 0; repeat < 10; ++repeat) {  // held down, as X11 sends it
            atMs += 33;
            releaseAt(open, key, letter, atMs);
            pressAt(open, key, letter, atMs);
        }
        releaseAt(open, key, letter, atMs + 20);
        QCOMPARE(reasonIn(open), QString());
        pressKey(open, Qt::Key_Escape);

        atMs += 5000;
        pressAt(open, key, letter, atMs);
        releaseAt(open, key, letter, atMs + 40);
        pressAt(open, key, letter, atMs + 60);  // bounced
        QCOMPARE(reasonIn(open), QString());
        pressAt(open, key, letter, atMs + 700);
        pressAt(open, key, letter, atMs + 760);
        QCOMPARE(reasonIn(open), letter + letter);
    }

    void aBouncedEnterDoesNotAnswerTheSecondQuestion_data()
    {
        QTest::addColumn<int>("key");
        QTest::newRow("correction") << int(Qt::Key_L);
        QTest::newRow("withdrawal") << int(Qt::Key_W);
    }
    void aBouncedEnterDoesNotAnswerTheSecondQuestion()
    {
        QFETCH(int, key);
        OpenWindow open(newStudy({.deadTimeSeconds = deadTimeSeconds}));
        open.enrolAndBegin();
        open.playTo("Presenting", "Q1");
        open.playTo("PlacingTray");
        open.clock().advanceSeconds(5);
        const auto stored = [&] { return open.window().study()->store().events(protocols::ParticipantId("P01")).size(); };
        const std::size_t before = stored();
        const bool isB = open.window().session()->correctables().front().current.startsWith('B');
        pressKey(open, static_cast<Qt::Key>(key));
        typeText(open, key == Qt::Key_W ? "P01" : isB ? "A" : "B");
        pressKey(open, Qt::Key_Return);
        QVERIFY2(open.message().contains("Press Enter again"), qPrintable(open.message()));
        open.clock().advanceSeconds(bounceSeconds);
        pressKey(open, Qt::Key_Return);
        QCOMPARE(stored(), before);
        QVERIFY2(open.message().contains("only just"), qPrintable(open.message()));
        open.clock().advanceSeconds(deadTimeSeconds);
        pressKey(open, Qt::Key_Return);
        QCOMPARE(stored(), before + 1);
    }

    void aBouncedEnterStoresNoEmptyWords()
    {
        StudyRecipe recipe;
        recipe.protocol =
            R"({"schema": "vis2hap.protocol/1", "name": "Words", "participants": 2, "fabrics": ["F01", "F02", "F03"],
            "conditions": ["v_grey", "h&f"], "seconds_per_presentation": 30, "dead_time_seconds": 0.7,
            "phases": [{"questions": ["Pick", "Why"], "alternatives": 2, "free_text": ["Why"]}],
            "question_texts": {"Pick": "Which of the two?", "Why": "What did you feel?"}})";
        const auto folder = newStudy(recipe);
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.playTo("Presenting", "Why");
        open.clock().advanceSeconds(5);
        pressKey(open, Qt::Key_Return);
        open.clock().advanceSeconds(bounceSeconds);
        pressKey(open, Qt::Key_Return);
        QCOMPARE(answersIn(folder).size(), std::size_t(1));
        open.clock().advanceSeconds(deadTimeSeconds);
        pressKey(open, Qt::Key_Return);
        QCOMPARE(answersIn(folder).size(), std::size_t(2));
    }

    /// Who types an answer at the tray, and Enter, believes that the presentation runs.
    void anEnterAfterAnAnswerTypedTooEarlyArmsNothing()
    {
        OpenWindow open(newStudy({.deadTimeSeconds = deadTimeSeconds}));
        open.enrolAndBegin();
        open.clock().advanceSeconds(5);
        pressKey(open, Qt::Key_A);
        pressKey(open, Qt::Key_Return);
        QVERIFY2(open.message().contains("once more"), qPrintable(open.message()));
        open.clock().advanceSeconds(bounceSeconds);
        pressKey(open, Qt::Key_Return);
        QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
        QVERIFY2(open.message().contains("only just"), qPrintable(open.message()));
        open.clock().advanceSeconds(deadTimeSeconds);
        pressKey(open, Qt::Key_Return);
        QCOMPARE(nameOf(open.view().state), std::string("Presenting"));
    }

    void theEnterAfterASessionIsRefusedAloud()
    {
        OpenWindow open(newStudy());
        open.enrolAndBegin();
        open.playToEnd();
        pressKey(open, Qt::Key_Return);
        QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
        open.clock().advanceSeconds(bounceSeconds);
        pressKey(open, Qt::Key_Return);
        QVERIFY2(open.message("studyMessage").contains("only just"), qPrintable(open.message("studyMessage")));
    }

    void aBouncedEnterEnrolsNobodyBesideASession()
    {
        OpenWindow open(newStudy());
        open.enrolAndBegin();
        pressKey(open, Qt::Key_Q);
        QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
        open.clock().advanceSeconds(2);
        open.widget<QLineEdit>("participantField").setFocus();
        pressKey(open, Qt::Key_Return);
        QVERIFY2(open.message("studyMessage").contains("Press Enter again"), qPrintable(open.message("studyMessage")));
        open.clock().advanceSeconds(bounceSeconds);
        pressKey(open, Qt::Key_Return);
        QVERIFY(!open.window().session());
        QVERIFY2(open.message("studyMessage").contains("only just"), qPrintable(open.message("studyMessage")));
        open.clock().advanceSeconds(deadTimeSeconds);
        pressKey(open, Qt::Key_Return);
        QTRY_VERIFY(open.window().session());
    }

    void leavingSaysThatThePauseIsNotStored_data()
    {
        QTest::addColumn<bool>("byClosing");
        QTest::newRow("Q") << false;
        QTest::newRow("X") << true;
    }
    void leavingSaysThatThePauseIsNotStored()
    {
        QFETCH(bool, byClosing);
        const auto folder = newStudy();
        CountingVfs disk;
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.playTo("Presenting", "Q1");
        disk.letWritesFailWith(SQLITE_FULL);
        pressKey(open, Qt::Key_A);
        pressKey(open, Qt::Key_Return);
        QVERIFY2(open.message().contains("disk is full"), qPrintable(open.message()));
        const auto leave = [&] {
            if (byClosing)
                open.window().close();
            else
                pressKey(open, Qt::Key_Q);
        };
        leave();
        QTRY_VERIFY2(open.message().contains("leave once more"), qPrintable(open.message()));
        QVERIFY2(open.message().contains("disk is full"), qPrintable(open.message()));
        QVERIFY(open.window().isVisible() && open.window().session());
        leave();
        QTRY_VERIFY(byClosing ? !open.window().isVisible() : !open.window().session());
        disk.letWritesFailWith(SQLITE_OK);
    }

    void aKeyJustAfterTheParticipantMovedOnIsRefusedAloud()
    {
        OpenWindow open(newStudy());
        open.window().startSession(protocols::ParticipantId("P01"));
        open.window().findChild<SessionPage*>()->holdKeys();
        pressKey(open, Qt::Key_Return);
        QCOMPARE(open.window().session()->eventsSent(), 0);
        QVERIFY2(open.message().contains("moved the session on"), qPrintable(open.message()));
    }

    void refusalsAreInView_data()
    {
        QTest::addColumn<int>("percent");
        QTest::newRow("usual text") << 100;
        QTest::newRow("larger text") << 150;
        QTest::newRow("twice as large") << 200;
        QTest::newRow("largest text") << 250;
    }
    /// German texts are the longest. Five pieces fill the page of a choice.
    void refusalsAreInView()
    {
        QFETCH(int, percent);
        LanguageInUse language("vis2hap 0.6.0");
        language.use("de");
        OpenWindow open(newStudy({.fabrics = 5, .alternatives = 5, .confirmPieces = true, .hasSwatchCodes = true}));
        open.window().setAppearance({Theme::Light, percent});
        open.window().resize(800, 600);
        open.enrolAndBegin();
        const auto* bar = open.window().findChild<MessageBar*>("sessionMessage");
        const auto isInView = [&] { return bar->isVisible() && bar->visibleRegion().boundingRect() == bar->rect(); };
        const auto refuses = [&](const char* what) {
            tests::settle(open.window());
            QVERIFY2(isInView(), what);
        };
        pressKey(open, Qt::Key_Return);
        refuses("a tray whose pieces are not confirmed");
        typeText(open, "no such piece");
        pressKey(open, Qt::Key_Return);
        refuses("a wrong piece");
        open.playTo("Presenting", "Q1");
        pressKey(open, Qt::Key_Return);
        refuses("Enter without a choice");
        pressKey(open, Qt::Key_PageDown);
        refuses("Enter without a choice, and scrolled");
        pressKey(open, Qt::Key_V);
        pressKey(open, Qt::Key_Return);
        refuses("a void without a reason");
        pressKey(open, Qt::Key_Escape);
        open.playTo("Presenting", "Q2");
        typeText(open, "99");
        pressKey(open, Qt::Key_Return);
        refuses("a rating outside the scale");
        open.window().setAppearance({});
    }
};

QTEST_MAIN(AppRefusalsTest)
#include "app_refusals_test.moc"
