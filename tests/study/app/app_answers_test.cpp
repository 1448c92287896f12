// Every kind of answer through the real widgets: typed, entered twice, corrected and flagged. Also the source of the first
// touch, and the names of the pieces of fabric.
#include <QApplication>
#include <QLabel>
#include <QPushButton>
#include <QTest>

#include "study/session/session_record.h"
#include "tests/support/played_session.h"
#include "tests/support/typed_answers.h"
#include "tests/support/whole_protocol.h"

using namespace study::session;
using namespace tests::support;
using protocols::ParticipantId;
using protocols::Tenths;

namespace {

bool isFinished(OpenWindow& open) { return std::holds_alternative<Finished>(open.view().state.stage); }

/// A different answer of the same kind.
GivenAnswer otherThan(const GivenAnswer& right, const View& view)
{
    if (const auto* fabric = std::get_if<protocols::FabricId>(&right))
        return view.trayIds[view.trayIds.front() == *fabric ? 1 : 0];
    if (const auto* rating = std::get_if<Tenths>(&right)) return Tenths{rating->value == 10 ? 20 : 10};
    if (const auto* sameness = std::get_if<Sameness>(&right)) return Sameness{!sameness->same};
    return Words{"something else"};
}

}  // namespace

class AppAnswersTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void secondEntryMustAgree_data();
    void secondEntryMustAgree();
    void theTimeOfAnAnswerIsThatOfItsBeginning();
    void anEmptiedEntryKeepsTheStampOfTheSpokenWord();
    void secondEnterStoresAnAnswerWithoutWords();
    void lettersAreTextInATextField();
    void correctionsOfEveryKindOfAnswer();
    void theLastAnswerHasTheNumbersOfItsScale();
    void flagNeedsNoReason();
    void touchIsStampedByTheDisplay();
    void keyStampsTheTouchThatTheDisplayMissed();
    void touchDuringANoteKeepsTheNote();
    void aPresentationNeedsFewKeys();
    void pagesNamePiecesByTheirCodesOnly();
};

void AppAnswersTest::secondEntryMustAgree_data()
{
    QTest::addColumn<QString>("question");
    for (const char* question : {"Q1", "W1", "S1", "Q2", "L1"}) QTest::newRow(question) << question;
}

void AppAnswersTest::secondEntryMustAgree()
{
    QFETCH(QString, question);
    const auto folder = newStudy(wholeStudy({.secondEntry = true}));
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", question.toStdString());
    const GivenAnswer right = responseTo(open.view());
    const GivenAnswer wrong = otherThan(right, open.view());
    const auto enter = [&](const GivenAnswer& response) {
        enterByKeys(open, response);
        pressKey(open, Qt::Key_Return);
    };
    const std::string asked = nowAsked(open);
    const auto before = answersIn(folder);
    enter(wrong);
    QCOMPARE(answersIn(folder), before);
    QVERIFY(open.widget<QLabel>("readBack").text().contains("Second entry"));
    enter(right);
    QCOMPARE(answersIn(folder), before);
    QVERIFY2(open.message().contains("differ"), qPrintable(open.message()));
    enter(right);
    QVERIFY(open.message().isEmpty());
    enter(right);
    QCOMPARE(answersIn(folder).size(), before.size() + 1);
    QCOMPARE(answersIn(folder).at(asked), answerText(right));
}

void AppAnswersTest::theLastAnswerHasTheNumbersOfItsScale()
{
    OpenWindow open(newStudy(wholeStudy()));
    open.enrolAndBegin();
    const auto lastAfter = [&](const char* question) {
        open.playTo("Presenting", question);
        answerByKeys(open, Tenths{20});
        return open.widget<QLabel>("lastAnswer").text();
    };
    QVERIFY2(lastAfter("Q2").endsWith("Q2: 2.0"), qPrintable(open.widget<QLabel>("lastAnswer").text()));
    QVERIFY2(lastAfter("L1").endsWith("L1: 2"), qPrintable(open.widget<QLabel>("lastAnswer").text()));
}

void AppAnswersTest::secondEnterStoresAnAnswerWithoutWords()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "W1");
    const std::string asked = nowAsked(open);
    pressKey(open, Qt::Key_Return);
    QVERIFY2(open.message().contains("without words"), qPrintable(open.message()));
    QVERIFY(!answersIn(folder).contains(asked));
    pressKey(open, Qt::Key_Return);
    QCOMPARE(answersIn(folder).at(asked), std::string());
}

void AppAnswersTest::lettersAreTextInATextField()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    open.enrolAndBegin();
    open.playTo("Presenting", "W1");
    const std::string asked = nowAsked(open);
    typeText(open, "quite flat, not warm,");
    QTest::keyClick(open.window().focusWidget(), Qt::Key_Return, Qt::ShiftModifier);
    typeText(open, "two pleats");
    QVERIFY(open.widget<QPushButton>("noteButton").text().contains("Alt N"));
    QTest::keyClick(open.window().focusWidget(), Qt::Key_T, Qt::AltModifier);
    QVERIFY(std::get<Presenting>(open.view().state.stage).touchedAtNs.has_value());
    QTest::keyClick(open.window().focusWidget(), Qt::Key_F, Qt::AltModifier);
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains("Flag"));
    pressKey(open, Qt::Key_Escape);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(answersIn(folder).at(asked), std::string("quite flat, not warm,\ntwo pleats"));
    open.playTo("Presenting", "Q1");
    QVERIFY(!open.widget<QPushButton>("noteButton").text().contains("Alt"));
}

void AppAnswersTest::theTimeOfAnAnswerIsThatOfItsBeginning()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    const auto wait = [&](double seconds) { open.clock().advanceSeconds(seconds); };
    const auto store = [&] {
        wait(4);
        pressKey(open, Qt::Key_Return);
        return database::StudyStore(folder, database::StudyStore::Access::Read).answers().back();
    };
    if (!std::get<Presenting>(open.view().state.stage).touchedAtNs) pressKey(open, Qt::Key_T);
    wait(1);
    typeText(open, "5");
    wait(1);
    typeText(open, ".4");
    auto stored = store();  // Q2: the first key counts, not Enter
    QCOMPARE(stored.responseSeconds, std::optional(1.0));
    QCOMPARE(stored.seconds, 6.0);
    QCOMPARE(stored.record.answerBegunBy, std::string("entry"));

    pressKey(open, Qt::Key_T);
    wait(0.5);
    pressKey(open, Qt::Key_F9);
    wait(2);
    typeText(open, "7");
    stored = store();  // Q3: the key that marks the spoken word counts
    QCOMPARE(stored.responseSeconds, std::optional(0.5));
    QCOMPARE(stored.record.answerBegunBy, std::string("spoken"));

    pressKey(open, Qt::Key_T);
    typeText(open, "3");
    wait(2);
    pressKey(open, Qt::Key_Backspace);
    wait(1);
    typeText(open, "8");
    stored = store();  // Q4: an entry that was emptied was no answer
    QCOMPARE(stored.responseSeconds, std::optional(3.0));
}

void AppAnswersTest::anEmptiedEntryKeepsTheStampOfTheSpokenWord()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    const auto wait = [&](double seconds) { open.clock().advanceSeconds(seconds); };
    const auto typeThenMark = [&] {
        pressKey(open, Qt::Key_T);
        wait(1);
        typeText(open, "5");
        wait(1);
        pressKey(open, Qt::Key_F9);
        QVERIFY(open.widget<QPushButton>("spokenButton").text().contains("stamped"));
        wait(1);
    };
    const auto store = [&] {
        wait(4);
        pressKey(open, Qt::Key_Return);
        return database::StudyStore(folder, database::StudyStore::Access::Read).answers().back();
    };
    typeThenMark();
    pressKey(open, Qt::Key_Backspace);
    wait(1);
    typeText(open, "7");
    auto stored = store();  // the first entry was no answer, so F9 is the earliest stamp
    QCOMPARE(stored.responseSeconds, std::optional(2.0));
    QCOMPARE(stored.record.answerBegunBy, std::string("spoken"));
    typeThenMark();
    stored = store();  // both stamps are left
    QCOMPARE(stored.responseSeconds, std::optional(1.0));
    QCOMPARE(stored.record.answerBegunBy, std::string("entry"));
}

void AppAnswersTest::correctionsOfEveryKindOfAnswer()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q3");
    const auto kept = answersIn(folder);
    for (const auto& correctable : open.window().session()->correctables()) {
        const std::string question = correctable.question.value;
        GivenAnswer now = Words{"other words"};
        if (question == "Q1")
            now =
                std::get<study::app::OptionsForm>(correctable.form).options[correctable.current.startsWith('A') ? 1 : 0].response;
        if (question == "S1") now = Sameness{correctable.current != "Same"};
        if (question == "Q2") now = Tenths{correctable.current == "3.3" ? 44 : 33};
        open.perform(Corrected{correctable.question, now, "misheard"});
        QVERIFY2(open.message().contains("is corrected"), qPrintable(open.message()));
    }
    int changed = 0;
    for (const auto& [asked, answer] : answersIn(folder)) changed += kept.at(asked) != answer ? 1 : 0;
    QCOMPARE(changed, 4);  // the latest answers to Q1, W1, S1 and Q2
}

void AppAnswersTest::flagNeedsNoReason()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder);
    open.enrolAndBegin();
    QVERIFY(!open.widget<QPushButton>("flagButton").isEnabled());  // nothing was presented yet
    open.playTo("Presenting", "Q1");
    pressKey(open, Qt::Key_F);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(open.message(), QString("The presentation is flagged."));
    open.perform(Noted{"a door slammed", true});
    const auto events = open.window().study()->store().events(ParticipantId("P01"));
    QCOMPARE(events.back().payloadJson, payloadJson(Noted{"a door slammed", true}));
    QCOMPARE(events[events.size() - 2].payloadJson, payloadJson(Noted{"", true}));
}

void AppAnswersTest::touchIsStampedByTheDisplay()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder, {}, {.calls = {}, .fault = {}, .reportsTouches = true, .touch = {}});
    open.enrolAndBegin();
    open.display().touch();  // a touch has no effect before the tray is ready
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
    open.perform(TrayReady{});
    QVERIFY(open.widget<QPushButton>("touchButton").text().contains("display reports"));
    open.clock().advanceSeconds(1);
    open.display().touch();
    open.clock().advanceSeconds(3);
    open.display().touch();  // only the first touch counts
    QVERIFY(open.widget<QPushButton>("touchButton").text().contains("display reported"));
    open.perform(Answered{responseTo(open.view())});
    const auto stored = storedIn(folder).front();
    QCOMPARE(stored.record.touchedBy, std::string("display"));
    QCOMPARE(stored.seconds, 4.5);  // 3 s, and 1.5 s that perform() adds
}

void AppAnswersTest::keyStampsTheTouchThatTheDisplayMissed()
{
    const auto folder = newStudy(wholeStudy());
    OpenWindow open(folder, {}, {.calls = {}, .fault = {}, .reportsTouches = true, .touch = {}});
    open.enrolAndBegin();
    open.perform(TrayReady{});
    pressKey(open, Qt::Key_T);
    QVERIFY(open.widget<QPushButton>("touchButton").text().contains("You stamped"));
    open.display().touch();
    open.perform(Answered{responseTo(open.view())});
    QCOMPARE(storedIn(folder).front().record.touchedBy, std::string("operator"));
}

void AppAnswersTest::touchDuringANoteKeepsTheNote()
{
    OpenWindow open(newStudy(wholeStudy()), {}, {.calls = {}, .fault = {}, .reportsTouches = true, .touch = {}});
    open.enrolAndBegin();
    open.perform(TrayReady{});
    pressKey(open, Qt::Key_N);
    typeText(open, "hands are co");
    open.display().touch();
    QVERIFY(std::get<Presenting>(open.view().state.stage).touchedAtNs.has_value());
    typeText(open, "ld");
    pressKey(open, Qt::Key_Return);
    const auto last = open.window().study()->store().events(ParticipantId("P01")).back();
    QCOMPARE(last.payloadJson, payloadJson(Noted{"hands are cold", false}));
}

/// From the confirmed tray to the next page, where the display stamps the touches: 3 keys for a choice, 13 for three ratings.
void AppAnswersTest::aPresentationNeedsFewKeys()
{
    struct KeyCounter : QObject {
        int presses = 0;
        bool eventFilter(QObject* watched, QEvent* event) override
        {
            presses += event->type() == QEvent::KeyPress && watched == QApplication::focusWidget();
            return false;
        }
    } counter;
    OpenWindow open(newStudy(), {}, {.calls = {}, .fault = {}, .reportsTouches = true, .touch = {}});
    open.enrolAndBegin();
    qApp->installEventFilter(&counter);
    std::map<std::string, int> most;
    while (open.view().answersStored < open.view().answersInAll) {
        open.playTo("PlacingTray");
        open.perform(TrayReady{});
        const std::string phase = open.view().phaseName;
        counter.presses = 0;
        while (nameOf(open.view().state) == "Presenting") {
            open.display().touch();
            if (phase == "Q1")
                enterByKeys(open, responseTo(open.view()));
            else
                typeText(open, "5.4");
            pressKey(open, Qt::Key_Return);
        }
        most[phase] = std::max(most[phase], counter.presses);
    }
    QVERIFY2(most["Q1"] >= 1 && most["Q1"] <= 3, qPrintable(QString::number(most["Q1"])));
    QVERIFY2(most["Q2-Q4"] >= 3 && most["Q2-Q4"] <= 13, qPrintable(QString::number(most["Q2-Q4"])));
}

void AppAnswersTest::pagesNamePiecesByTheirCodesOnly()
{
    OpenWindow open(newStudy(wholeStudy()));
    open.enrolAndBegin();
    std::set<QString> names;
    for (const auto& [fabric, name] : open.window().study()->store().facts().fabricNames)
        names.insert(QString::fromStdString(name));
    while (!isFinished(open)) {
        for (const QString& text : textsIn(open.window()))
            for (const QString& name : names) QVERIFY2(!text.contains(name), qPrintable(text));
        if (std::holds_alternative<PlacingTray>(open.view().state.stage)) {
            const QString piece = open.widget<QLabel>("slotPiece").text();
            QCOMPARE(piece, QString::fromStdString(open.view().tray.front()));
        }
        open.perform(open.nextEvent());
    }
}

QTEST_MAIN(AppAnswersTest)
#include "app_answers_test.moc"
