// Keys that operators choose, barcode scanners, and the latency task, in the real window.
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QTest>
#include <QTreeWidget>
#include <cmath>

#include "study/app/pages/setup/keys_page.h"
#include "study/app/pages/setup/latency_page.h"
#include "tests/support/typed_answers.h"

using namespace study::app;
using namespace study::session;
using namespace tests::support;

namespace {

/// A key as a device sends it, with its time.
void deviceKey(OpenWindow& open, int key, const QString& text, ulong atMs)
{
    QKeyEvent press(QEvent::KeyPress, key, Qt::NoModifier, text);
    press.setTimestamp(atMs);
    QApplication::sendEvent(open.window().focusWidget(), &press);
}

/// Types the characters and the end with a gap between any two, ms.
void deviceTypes(OpenWindow& open, const QString& text, Qt::Key end, ulong gapMs)
{
    static ulong atMs = 100000;
    atMs += 10000;
    for (const QChar character : text) deviceKey(open, character.toUpper().unicode(), character, atMs += gapMs);
    deviceKey(open, end, end == Qt::Key_Tab ? "\t" : "\r", atMs + gapMs);
}

/// Holds a key for a second, as X11 sends it: every repeat is a release and a press at the same time, and no repeat by its flag.
void holdKey(OpenWindow& open, int key, const QString& text)
{
    static ulong atMs = 5000000;
    const auto send = [&](QEvent::Type type) {
        QKeyEvent event(type, key, Qt::NoModifier, text);
        event.setTimestamp(atMs);
        QWidget* focused = open.window().focusWidget();
        QApplication::sendEvent(focused ? focused : &open.window(), &event);
        QApplication::processEvents();
    };
    atMs += 10000;
    send(QEvent::KeyPress);
    atMs += 500;
    for (int repeat = 0; repeat < 15; ++repeat, atMs += 33) {
        send(QEvent::KeyRelease);
        send(QEvent::KeyPress);
    }
    send(QEvent::KeyRelease);
}

bool isTouched(OpenWindow& open)
{
    const auto* presenting = std::get_if<Presenting>(&open.view().state.stage);
    return presenting && presenting->touchedAtNs;
}

}  // namespace

class AppKeysTest : public tests::support::WindowTest {
    Q_OBJECT

    AppOptions remembering(const char* file)
    {
        AppOptions options;
        options.settings = std::make_shared<QSettings>(filePath(QString::fromLatin1(file)), QSettings::IniFormat);
        return options;
    }
    /// Gives the act the key by the page, from the page of the study and back.
    void bindByThePage(OpenWindow& open, KeyAct act, int key)
    {
        open.widget<QPushButton>("studyKeysButton").click();
        auto& list = open.widget<QTreeWidget>("actsList");
        list.setCurrentItem(list.topLevelItem(static_cast<int>(act)));
        list.setFocus();
        pressKey(open, Qt::Key_Return);
        QVERIFY(open.message("keysMessage").contains("Press the key or the pedal"));
        deviceKey(open, key, {}, 0);
    }

private Q_SLOTS:
    void aPedalActsBesideTheUsualKey()
    {
        const auto folder = newStudy();
        OpenWindow open(folder, remembering("pedal.ini"));
        bindByThePage(open, KeyAct::Touch, Qt::Key_F13);
        QVERIFY2(open.message("keysMessage").contains("F13 now acts as “Stamp the first touch”"),
                 qPrintable(open.message("keysMessage")));
        pressKey(open, Qt::Key_Escape);
        bindByThePage(open, KeyAct::Confirm, Qt::Key_PageDown);
        pressKey(open, Qt::Key_Escape);
        bindByThePage(open, KeyAct::Void, Qt::Key_F14);
        pressKey(open, Qt::Key_Escape);
        bindByThePage(open, KeyAct::AnswerBegins, Qt::Key_F15);
        pressKey(open, Qt::Key_Escape);
        QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));

        open.enrolAndBegin();
        QVERIFY(open.widget<QPushButton>("trayReadyButton").text().contains("(Enter or Page Down)"));
        pressKey(open, Qt::Key_PageDown);
        QCOMPARE(nameOf(open.view().state), std::string("Presenting"));
        QVERIFY(open.widget<QPushButton>("touchButton").text().contains("T or F13"));
        QVERIFY(open.widget<QPushButton>("spokenButton").text().contains("F9 or F15"));
        QVERIFY(open.widget<QPushButton>("voidButton").text().contains("V or F14"));
        QVERIFY(!isTouched(open));
        pressKey(open, Qt::Key_F13);
        QVERIFY(isTouched(open));
        open.clock().advanceSeconds(2);
        pressKey(open, Qt::Key_F15);
        QVERIFY(!open.widget<QPushButton>("spokenButton").isEnabled());
        open.clock().advanceSeconds(1);
        pressKey(open, Qt::Key_A);
        pressKey(open, Qt::Key_PageDown);
        QCOMPARE(answersIn(folder).size(), std::size_t(1));
        QCOMPARE(storedIn(folder)[0].record.answerBegunBy, std::string("spoken"));

        open.playTo("Presenting", "Q2");  // a text field has the focus
        pressKey(open, Qt::Key_T);
        QVERIFY(isTouched(open));  // the usual key
        typeText(open, "5");
        const std::size_t before = answersIn(folder).size();
        pressKey(open, Qt::Key_PageDown);
        QCOMPARE(answersIn(folder).size(), before + 1);
        pressKey(open, Qt::Key_F14);
        QVERIFY(open.widget<QLabel>("pageTitle").text().contains("oid"));
        pressKey(open, Qt::Key_Escape);
    }

    /// Of six slots, F is one. The pedal still sets a flag.
    void aPedalIsNoLetterOfATray()
    {
        OpenWindow open(newStudy({.fabrics = 6, .alternatives = 6}), remembering("letters.ini"));
        bindByThePage(open, KeyAct::Flag, Qt::Key_F14);
        pressKey(open, Qt::Key_Escape);
        open.enrolAndBegin();
        open.playTo("PlacingTray");
        const QString before = open.message();
        pressKey(open, Qt::Key_F14);  // there is nothing to flag yet
        QCOMPARE(open.message(), before);
        open.playTo("Presenting", "Q1");
        open.playTo("PlacingTray");
        for (const char* stage : {"PlacingTray", "Presenting"}) {
            open.playTo(stage);
            pressKey(open, Qt::Key_F14);
            QVERIFY2(open.widget<QLabel>("pageTitle").text().startsWith("Flag"), stage);
            pressKey(open, Qt::Key_Escape);
        }
    }

    void clashesAreNamed_data()
    {
        QTest::addColumn<int>("key");
        QTest::addColumn<QString>("said");
        QTest::newRow("a standard key") << int(Qt::Key_F9) << "F9 is the standard key of “The answer begins";
        QTest::newRow("a letter") << int(Qt::Key_B) << "characters are answers";
        QTest::newRow("another letter's act") << int(Qt::Key_V) << "V is the standard key of “Void the presentation”";
        QTest::newRow("a digit") << int(Qt::Key_7) << "characters are answers";
        QTest::newRow("an editing key") << int(Qt::Key_Home) << "moves or edits in a field";
        QTest::newRow("Tab") << int(Qt::Key_Tab) << "moves or edits in a field";
        QTest::newRow("Enter of the number pad") << int(Qt::Key_Enter) << "moves or edits in a field";
        QTest::newRow("a key in use") << int(Qt::Key_F16) << "F16 acts as “Write a note” already";
        QTest::newRow("a dead accent") << int(Qt::Key_Dead_Acute) << "characters are answers";
    }
    void clashesAreNamed()
    {
        QFETCH(int, key);
        QFETCH(QString, said);
        OpenWindow open(newStudy(), remembering("clash.ini"));
        bindByThePage(open, KeyAct::Note, Qt::Key_F16);
        pressKey(open, Qt::Key_Escape);
        bindByThePage(open, KeyAct::Touch, key);
        QVERIFY2(open.message("keysMessage").contains(said), qPrintable(open.message("keysMessage")));
        pressKey(open, Qt::Key_F17);  // the page still waits
        QVERIFY(open.message("keysMessage").contains("F17 now acts"));
        KeyBindings keys = rememberedKeys(remembering("clash.ini").settings.get());
        QCOMPARE(keys.extraKey(KeyAct::Touch), std::optional<int>(Qt::Key_F17));
    }

    void keysAreRememberedAndRemoved()
    {
        const auto folder = newStudy();
        {
            OpenWindow open(folder, remembering("kept.ini"));
            bindByThePage(open, KeyAct::Pause, Qt::Key_F20);
            pressKey(open, Qt::Key_Escape);
            bindByThePage(open, KeyAct::Flag, Qt::Key_MediaPlay);
        }
        {
            OpenWindow open(folder, remembering("kept.ini"));
            open.enrolAndBegin();
            QVERIFY(open.widget<QPushButton>("pauseButton").text().contains("Esc or F20"));
            pressKey(open, Qt::Key_F20);
            QVERIFY(open.view().state.paused);
        }
        {
            OpenWindow open(folder, remembering("kept.ini"));
            bindByThePage(open, KeyAct::Pause, Qt::Key_Escape);  // Esc changes nothing
            QCOMPARE(open.message("keysMessage"), QString("Nothing is changed."));
            pressKey(open, Qt::Key_Delete);
            QVERIFY(open.message("keysMessage").contains("“Pause” has only its usual key"));
            open.widget<QPushButton>("resetKeysButton").click();
        }
        QVERIFY(rememberedKeys(remembering("kept.ini").settings.get()) == KeyBindings());
        // Settings that somebody edited by hand give no key that clashes.
        const auto settings = remembering("kept.ini").settings;
        settings->setValue("extraKeys/touch", int(Qt::Key_B));
        settings->setValue("extraKeys/note", "no key");
        settings->setValue("extraKeys/flag", int(Qt::Key_F21));
        const KeyBindings keys = rememberedKeys(settings.get());
        QVERIFY(!keys.extraKey(KeyAct::Touch) && !keys.extraKey(KeyAct::Note));
        QCOMPARE(keys.extraKey(KeyAct::Flag), std::optional<int>(Qt::Key_F21));
    }

    void aScannerStoresNoAnswer_data()
    {
        QTest::addColumn<QString>("question");
        QTest::addColumn<QString>("code");
        QTest::addColumn<int>("end");
        QTest::newRow("a choice") << "Q1"
                                  << "a829" << int(Qt::Key_Return);
        QTest::newRow("a rating") << "Q2"
                                  << "55" << int(Qt::Key_Return);
        QTest::newRow("a rating, Enter of the number pad") << "Q2"
                                                           << "55" << int(Qt::Key_Enter);
        QTest::newRow("Tab") << "Q2"
                             << "5.5" << int(Qt::Key_Tab);
        QTest::newRow("a code that opens the form of a void") << "Q1"
                                                              << "v663" << int(Qt::Key_Return);
        QTest::newRow("a code that opens the form of a note") << "Q2"
                                                              << "n663" << int(Qt::Key_Return);
    }
    void aScannerStoresNoAnswer()
    {
        QFETCH(QString, question);
        QFETCH(QString, code);
        QFETCH(int, end);
        const auto folder = newStudy();
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.playTo("Presenting", question.toStdString());
        const auto before = answersIn(folder);
        const auto events = open.window().study()->store().events(protocols::ParticipantId("P01")).size();
        deviceTypes(open, code, static_cast<Qt::Key>(end), 8);
        QVERIFY(answersIn(folder) == before);
        QCOMPARE(open.window().study()->store().events(protocols::ParticipantId("P01")).size(), events);
        QVERIFY2(open.message().contains("A scanner typed this"), qPrintable(open.message()));
    }

    /// What a scanner typed is emptied, so that a later Enter stores nothing of it.
    void nothingOfAScannerIsLeft()
    {
        const auto folder = newStudy();
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.playTo("Presenting", "Q2");
        const auto before = answersIn(folder);
        deviceTypes(open, "55", Qt::Key_Return, 8);
        QCOMPARE(open.widget<QLineEdit>("ratingField").text(), QString());
        pressKey(open, Qt::Key_Return);
        QVERIFY(answersIn(folder) == before);
        deviceTypes(open, "5.5", Qt::Key_Return, 60);  // a quick hand
        QCOMPARE(answersIn(folder).size(), before.size() + 1);
    }

    /// Else an input method, such as one for Chinese, would compose words from the letters that are keys.
    void noInputMethodReadsARating()
    {
        OpenWindow open(newStudy());
        open.enrolAndBegin();
        open.playTo("Presenting", "Q2");
        const auto& field = open.widget<QLineEdit>("ratingField");
        QVERIFY(field.hasFocus());
        QVERIFY(!field.testAttribute(Qt::WA_InputMethodEnabled));
    }

    void aScannerConfirmsPieces()
    {
        StudyRecipe recipe;
        recipe.confirmPieces = true;
        OpenWindow open(newStudy(recipe));
        open.window().startSession(protocols::ParticipantId("P01"));
        open.playTo("PlacingTray");
        const auto tray = open.view().tray;
        for (const std::string& piece : tray) deviceTypes(open, QString::fromStdString(piece), Qt::Key_Return, 4);
        QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));  // the last Enter belongs to the code
        deviceTypes(open, "xyz", Qt::Key_Return, 4);                      // one scan too many
        QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
        pressKey(open, Qt::Key_Return);
        QCOMPARE(nameOf(open.view().state), std::string("Presenting"));
    }

    void latencyCountsTapsMissesAndAnticipations()
    {
        constexpr std::int64_t ms = 1'000'000;
        LatencyTask task(0, 7);
        std::int64_t now = 0;
        int given = 0;
        std::vector<double> expected;
        for (LatencyTask::Step step = task.advance(now); step != LatencyTask::Step::Done; step = task.advance(now += ms)) {
            if (step != LatencyTask::Step::GiveSignal) continue;
            task.signalGiven(now);
            ++given;
            if (given == 3) continue;  // missed
            if (given == 5) {
                QVERIFY(!task.tap(now + 99 * ms));  // too early
                continue;
            }
            const std::int64_t latency = (180 + 10 * given) * ms;
            QVERIFY(task.tap(now + latency));
            expected.push_back(180 + 10 * given);
            if (given == 7) QVERIFY(!task.tap(now + latency + ms));  // twice
        }
        QVERIFY2(now >= LatencyTask::durationNs && now < LatencyTask::durationNs + 2 * LatencyTask::missedAfterNs,
                 qPrintable(QString::number(now)));
        QVERIFY2(given > 24 && given < 75, qPrintable(QString::number(given)));
        const auto run = task.result();
        QCOMPARE(run.taps, given - 2);
        QCOMPARE(run.misses, 1);
        QCOMPARE(run.anticipations, 2);
        // numpy: quantile(x, [0.25, 0.5, 0.75]) of an even or odd number of values
        const auto quantile = [&](double share) {
            const double place = share * static_cast<double>(expected.size() - 1);
            const auto below = static_cast<std::size_t>(place);
            const double rest = place - static_cast<double>(below);
            return rest == 0 ? expected[below] : expected[below] * (1 - rest) + expected[below + 1] * rest;
        };
        QVERIFY(std::abs(*run.medianMs - quantile(0.5)) < 1e-9);
        QVERIFY(std::abs(*run.q1Ms - quantile(0.25)) < 1e-9 && std::abs(*run.q3Ms - quantile(0.75)) < 1e-9);
        QVERIFY(!LatencyTask(0, 1).result().medianMs);
    }

    void theLatencyTaskIsStoredInTheStudy()
    {
        const auto folder = newStudy();
        OpenWindow open(folder);
        open.widget<QPushButton>("studyKeysButton").click();
        open.widget<QPushButton>("latencyTaskButton").click();
        QCOMPARE(open.window().currentPage()->objectName(), QString("latencyPage"));
        open.widget<QLineEdit>("latencyOperatorField").clear();
        open.widget<QPushButton>("latencyFlashButton").click();
        QVERIFY(open.message("latencyMessage").contains("name of the operator is missing"));
        open.widget<QLineEdit>("latencyOperatorField").setText("Ada");
        open.widget<QPushButton>("latencyFlashButton").click();
        auto& lamp = open.widget<QLabel>("latencyLamp");
        auto& page = static_cast<LatencyPage&>(*open.window().currentPage());
        open.clock().advanceSeconds(5);
        QTRY_COMPARE(lamp.text(), QString("Now"));
        pressKey(open, Qt::Key_Escape);
        QVERIFY(!page.isRunning());
        QVERIFY(open.message("latencyMessage").contains("Nothing is stored"));
        QVERIFY(database::operatorLatenciesOf(dynamic_cast<database::StudyStore&>(open.window().study()->store())).empty());

        open.widget<QPushButton>("latencyFlashButton").click();
        int taps = 0;
        while (page.isRunning()) {
            open.clock().advanceSeconds(4.6);  // longer than any wait
            QTRY_VERIFY(lamp.text() == "Now" || !page.isRunning());
            if (!page.isRunning()) break;
            open.clock().advanceSeconds(0.25);
            pressKey(open, Qt::Key_Space);
            ++taps;
        }
        const auto runs = database::operatorLatenciesOf(dynamic_cast<database::StudyStore&>(open.window().study()->store()));
        QCOMPARE(runs.size(), std::size_t(1));
        QCOMPARE(runs[0].operatorName, std::string("Ada"));
        QCOMPARE(runs[0].signal, std::string("flash"));
        QCOMPARE(runs[0].taps, taps);
        QCOMPARE(runs[0].medianMs, std::optional(250.0));
        QVERIFY(open.message("latencyMessage").contains("median 250 ms"));
        pressKey(open, Qt::Key_Escape);
        pressKey(open, Qt::Key_Escape);
        QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
        QVERIFY(dynamic_cast<database::StudyStore&>(open.window().study()->store()).faults().empty());
    }

    void aHeldEnterConfirmsOnePage_data()
    {
        QTest::addColumn<QString>("stage");
        for (const char* stage : {"Enrolled", "Consenting", "OnBreak", "Debriefing"}) QTest::newRow(stage) << stage;
    }
    void aHeldEnterConfirmsOnePage()
    {
        QFETCH(QString, stage);
        OpenWindow open(newStudy());
        open.window().startSession(protocols::ParticipantId("P01"));
        open.playTo(stage.toStdString());
        const int before = open.window().session()->eventsSent();
        holdKey(open, Qt::Key_Return, "\r");
        QVERIFY(open.window().session());
        QCOMPARE(open.window().session()->eventsSent(), before + 1);
    }

    void aHeldEnterStoresOneAnswerAndVoidsNothing()
    {
        const auto folder = newStudy();
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.playTo("Presenting", "Q1");
        pressKey(open, Qt::Key_A);
        holdKey(open, Qt::Key_Return, "\r");
        QCOMPARE(answersIn(folder).size(), std::size_t(1));
        QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
        pressKey(open, Qt::Key_V);
        holdKey(open, Qt::Key_Enter, "\r");
        QVERIFY2(open.message().contains("Write a short reason"), qPrintable(open.message()));
        for (const auto& stored : storedIn(folder)) QVERIFY(!stored.voided);
    }

    void aHeldEnterStoresNoEmptyWords()
    {
        StudyRecipe recipe;
        recipe.protocol =
            R"({"schema": "vis2hap.protocol/1", "name": "Words", "participants": 2, "fabrics": ["F01", "F02", "F03"],
            "conditions": ["v_grey", "h&f"], "seconds_per_presentation": 30, "dead_time_seconds": 0,
            "phases": [{"questions": ["Pick", "Why"], "alternatives": 2, "free_text": ["Why"]}],
            "question_texts": {"Pick": "Which of the two?", "Why": "What did you feel?"}})";
        const auto folder = newStudy(recipe);
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.playTo("Presenting", "Why");
        holdKey(open, Qt::Key_Return, "\r");
        QCOMPARE(answersIn(folder).size(), std::size_t(1));
        QCOMPARE(open.view().question->id.value, std::string("Why"));
    }

    void aHeldEnterEnrolsNobodyElse()
    {
        OpenWindow open(newStudy({.participants = 4}));
        open.window().startSession(protocols::ParticipantId("P01"));
        open.playToEnd();
        holdKey(open, Qt::Key_Return, "\r");
        QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
        QCOMPARE(open.window().study()->store().enrolments().size(), std::size_t(1));
        open.clock().advanceSeconds(2);
        holdKey(open, Qt::Key_Return, "\r");  // enrols, and begins nothing
        QVERIFY(open.window().session());
        QCOMPARE(nameOf(open.view().state), std::string("Enrolled"));
    }

    void aHeldPedalConfirmsOnce()
    {
        OpenWindow open(newStudy(), remembering("held.ini"));
        bindByThePage(open, KeyAct::Confirm, Qt::Key_F13);
        pressKey(open, Qt::Key_Escape);
        open.window().startSession(protocols::ParticipantId("P01"));
        holdKey(open, Qt::Key_F13, {});
        QCOMPARE(open.window().session()->eventsSent(), 1);
        open.playTo("Presenting", "Q2");  // a text field has the focus
        open.playTo("PlacingTray");
        const int before = open.window().session()->eventsSent();
        holdKey(open, Qt::Key_F13, {});
        QCOMPARE(open.window().session()->eventsSent(), before + 1);
    }

    void aHeldDigitShowsOneFabricOnce()
    {
        OpenWindow open(newStudy({.familiarisationImages = 2}));
        open.window().startSession(protocols::ParticipantId("P01"));
        open.playTo("Familiarising");
        const int before = open.window().session()->eventsSent();
        holdKey(open, Qt::Key_1, "1");
        QCOMPARE(open.window().session()->eventsSent(), before + 1);
    }

    void aHeldSpacePressesOneButton()
    {
        OpenWindow open(newStudy());
        open.window().startSession(protocols::ParticipantId("P01"));
        open.widget<QPushButton>("confirmButton").setFocus();
        holdKey(open, Qt::Key_Space, " ");
        QCOMPARE(open.window().session()->eventsSent(), 1);
    }

    void lettersAndBackspaceRepeatInAText()
    {
        OpenWindow open(newStudy());
        open.enrolAndBegin();
        pressKey(open, Qt::Key_N);
        auto& field = open.widget<QPlainTextEdit>("reasonField");
        holdKey(open, Qt::Key_X, "x");
        QCOMPARE(field.toPlainText(), QString(16, 'x'));
        holdKey(open, Qt::Key_Space, " ");
        QCOMPARE(field.toPlainText().size(), 32);
        holdKey(open, Qt::Key_Left, {});
        QCOMPARE(field.textCursor().position(), 16);
        holdKey(open, Qt::Key_Backspace, "\b");
        QCOMPARE(field.toPlainText(), QString(16, ' '));
    }
};

QTEST_MAIN(AppKeysTest)
#include "app_keys_test.moc"
