// Events that an experimenter meets during a session: corrections, notes, voids, a withdrawal, a display that fails, a key
// held down. Through the real widgets.
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>

#include "study/app/state/tray_steps.h"
#include "tests/support/typed_answers.h"

using namespace study::session;
using namespace tests::support;
using protocols::Tenths;

class AppOperatorTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void lastAnswerIsCorrectedWithItsReason();
    void earlierQuestionCanStillBeCorrected();
    void theStoredAnswerIsNoCorrection();
    void stopForNowLeadsBackToTheStudy();
    void voidedPresentationIsRepeated();
    void noteIsStored();
    void withdrawalNeedsNoReason();
    void trayMarksOnlyPiecesThatChange();
    void aWithdrawalAsksForTheCode();
    void aBouncedEnterArmsNothing();
    void everyLetterOfTheTrayComesTooEarly();
    void aWrongPieceIsCaughtBeforeThePresentation();
    void theTrayPageSaysWhatToDo_data();
    void theTrayPageSaysWhatToDo();
    void theHeaderShowsWhetherAnImageIsFelt();
    void aVoidBeforeAnyAnswerAddsNoAnswer();
    void answersOfAVoidedPresentationAreNotCounted();
    void heldKeyStoresOneAnswer();
    void displayFaultPausesAndLosesNothing();
    void enterStoresNothingBeforeAChoice();
    void aBouncedEnterAfterAPanelArmsNothing_data();
    void aBouncedEnterAfterAPanelArmsNothing();
    void aBouncedEnterConfirmsNoPage();
    void aDeadTimeOfZeroHoldsNothingBack();
    void whatTheParticipantEntersHoldsNothingBack();
    void theEnterThatLeavesASessionEnrolsNobody_data();
    void theEnterThatLeavesASessionEnrolsNobody();
    void closingAsksAboutATextThatIsNotStored_data();
    void closingAsksAboutATextThatIsNotStored();
    void leavingAsksAboutADebriefingThatIsNotStored();
    void aStoredTextIsNotAskedAbout();

private:
    /// Opens the panel by its key and types a reason; on the debriefing page (no key) types the comment.
    static void typeReason(OpenWindow& open, int key);
};

namespace {

constexpr double bounceSeconds = 0.06;

/// The letter of an answer that is not the stored one.
const char* letterToCorrectTo(OpenWindow& open)
{
    return open.window().session()->correctables().front().current.startsWith('B') ? "A" : "B";
}

void addPanels()
{
    QTest::addColumn<int>("key");
    QTest::newRow("note") << int(Qt::Key_N);
    QTest::newRow("flag") << int(Qt::Key_F);
    QTest::newRow("void") << int(Qt::Key_V);
    QTest::newRow("correction") << int(Qt::Key_L);
}

}  // namespace

void AppOperatorTest::typeReason(OpenWindow& open, int key)
{
    if (key != 0) pressKey(open, static_cast<Qt::Key>(key));
    if (key == Qt::Key_L) {
        typeText(open, letterToCorrectTo(open));
        open.widget<QPlainTextEdit>("reasonField").setFocus();
    }
    typeText(open, "the lorry again");
}

void AppOperatorTest::aBouncedEnterAfterAPanelArmsNothing_data() { addPanels(); }

void AppOperatorTest::aBouncedEnterAfterAPanelArmsNothing()
{
    QFETCH(int, key);
    OpenWindow open(newStudy({.deadTimeSeconds = 0.7}));
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    open.playTo("PlacingTray");
    open.clock().advanceSeconds(5);
    typeReason(open, key);
    const auto stored = [&] { return open.window().study()->store().events(protocols::ParticipantId("P01")).size(); };
    const std::size_t before = stored();
    pressKey(open, Qt::Key_Return);
    QCOMPARE(stored(), before + 1);
    open.clock().advanceSeconds(bounceSeconds);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
    QCOMPARE(stored(), before + 1);
    QVERIFY2(open.message().contains("only just"), qPrintable(open.message()));
    open.clock().advanceSeconds(0.7);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("Presenting"));
}

void AppOperatorTest::aBouncedEnterConfirmsNoPage()
{
    const auto folder = newStudy({.deadTimeSeconds = 0.7});
    OpenWindow open(folder);
    open.window().startSession(protocols::ParticipantId("P01"));
    std::set<std::string> stages;
    while (!std::holds_alternative<Finished>(open.view().state.stage)) {
        const State shown = open.view().state;
        open.clock().advanceSeconds(bounceSeconds);
        pressKey(open, Qt::Key_Return);
        QVERIFY2(open.view().state == shown, nameOf(shown).c_str());
        stages.insert(nameOf(shown));
        open.perform(open.nextEvent());
    }
    for (const char* stage : {"Enrolled", "Consenting", "PlacingTray", "Presenting", "OnBreak", "Debriefing"})
        QVERIFY2(stages.contains(stage), stage);
    QCOMPARE(answersIn(folder).size(), std::size_t(24));
}

void AppOperatorTest::aDeadTimeOfZeroHoldsNothingBack()
{
    OpenWindow open(newStudy({.deadTimeSeconds = 0}));
    open.enrolAndBegin();
    typeReason(open, Qt::Key_N);
    pressKey(open, Qt::Key_Return);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("Presenting"));
}

void AppOperatorTest::whatTheParticipantEntersHoldsNothingBack()
{
    OpenWindow open(newStudy({.deadTimeSeconds = 0.7}));
    open.window().startSession(protocols::ParticipantId("P01"));
    open.perform(Begun{});
    QCOMPARE(nameOf(open.view().state), std::string("Consenting"));
    open.window().session()->send(Consented{EnteredBy::Participant});  // at once: this is another person's hand
    QVERIFY(nameOf(open.view().state) != "Consenting");
    open.playTo("PlacingTray");
    open.clock().advanceSeconds(0.7);
    open.window().session()->displayTouched();
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("Presenting"));
}

void AppOperatorTest::theEnterThatLeavesASessionEnrolsNobody_data()
{
    QTest::addColumn<bool>("isFinished");
    QTest::newRow("finished") << true;
    QTest::newRow("withdrawn") << false;
}

void AppOperatorTest::theEnterThatLeavesASessionEnrolsNobody()
{
    QFETCH(bool, isFinished);
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    if (isFinished)
        open.playToEnd();
    else
        open.perform(WithdrawnEvent{"tired"});
    pressKey(open, Qt::Key_Return);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    open.clock().advanceSeconds(bounceSeconds);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(open.window().study()->store().enrolments().size(), std::size_t(1));
    open.clock().advanceSeconds(0.7);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(open.window().study()->store().enrolments().size(), std::size_t(2));
}

void AppOperatorTest::closingAsksAboutATextThatIsNotStored_data()
{
    addPanels();
    QTest::newRow("debriefing") << 0;
}

void AppOperatorTest::closingAsksAboutATextThatIsNotStored()
{
    QFETCH(int, key);
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    open.playTo(key == 0 ? "Debriefing" : "PlacingTray");
    typeReason(open, key);
    auto& field = open.widget<QPlainTextEdit>(key == 0 ? "debriefingField" : "reasonField");

    open.window().close();
    QVERIFY(open.window().isVisible());
    QVERIFY(!open.view().state.paused);
    QCOMPARE(open.window().focusWidget()->objectName(), QString("stayButton"));  // so that Enter loses nothing
    pressKey(open, Qt::Key_Escape);
    QVERIFY(open.window().isVisible() && field.isVisible());
    QCOMPARE(field.toPlainText(), QString("the lorry again"));

    open.window().close();
    pressKey(open, Qt::Key_Return);
    QVERIFY(open.window().isVisible() && field.isVisible());
    QCOMPARE(field.toPlainText(), QString("the lorry again"));

    open.window().close();
    open.widget<QPushButton>("closeAnywayButton").click();
    QVERIFY(!open.window().isVisible());
    QVERIFY(open.view().state.paused);
}

void AppOperatorTest::leavingAsksAboutADebriefingThatIsNotStored()
{
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    open.playTo("Debriefing");
    typeText(open, "by the sound");
    QTest::keyClick(open.window().focusWidget(), Qt::Key_Q, Qt::AltModifier);
    QTRY_VERIFY(open.widget<QPushButton>("stayButton").isVisible());
    QVERIFY(!open.view().state.paused);
    open.widget<QPushButton>("stayButton").click();
    QCOMPARE(open.widget<QPlainTextEdit>("debriefingField").toPlainText(), QString("by the sound"));
    QTest::keyClick(open.window().focusWidget(), Qt::Key_Q, Qt::AltModifier);
    open.widget<QPushButton>("closeAnywayButton").click();
    QTRY_VERIFY(open.window().currentPage()->objectName() != "sessionPage");
    QVERIFY(open.window().isVisible());
}

void AppOperatorTest::aStoredTextIsNotAskedAbout()
{
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    typeReason(open, Qt::Key_N);
    pressKey(open, Qt::Key_Return);
    pressKey(open, Qt::Key_N);  // an empty panel holds nothing
    open.window().close();
    QVERIFY(!open.window().isVisible());
}

void AppOperatorTest::lastAnswerIsCorrectedWithItsReason()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    const std::string asked = nowAsked(open);
    answerByKeys(open, Tenths{54}, u'.');
    QVERIFY(open.widget<QLabel>("lastAnswer").text().contains("5.4"));

    pressKey(open, Qt::Key_L);
    QCOMPARE(open.widget<QLabel>("oldValue").text(), QString("5.4"));
    typeText(open, "4");
    pressKey(open, Qt::Key_Return);  // no reason yet
    QVERIFY(open.message().contains("Write a short reason"));
    QCOMPARE(answersIn(folder).at(asked), std::string("5.4"));
    typeText(open, "misheard, said four");  // these letters are command keys on other pages
    pressKey(open, Qt::Key_Return);

    QCOMPARE(answersIn(folder).at(asked), std::string("4"));
    QVERIFY(open.widget<QLabel>("lastAnswer").text().contains("4.0"));
    QCOMPARE(open.window().focusWidget()->objectName(), QString("ratingField"));  // the open question is in front again
    for (const auto& stored : storedIn(folder))
        if (stored.record.question.value == "Q2") {
            QCOMPARE(stored.corrections, 1);
            QVERIFY(stored.record.note.find("misheard, said four") != std::string::npos);
        }
}

void AppOperatorTest::earlierQuestionCanStillBeCorrected()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q3");  // the latest answers are to Q2 and, before it, Q1
    const auto correctable = open.window().session()->correctables();
    QCOMPARE(correctable.size(), std::size_t(2));
    const auto& options = std::get<study::app::OptionsForm>(correctable[1].form).options;
    const bool isFirst = textOf(correctable[1].form, options.front().response) == correctable[1].current;
    const auto other = std::get<protocols::FabricId>((isFirst ? options.back() : options.front()).response);
    const auto before = answersIn(folder);
    open.perform(Corrected{protocols::QuestionId("Q1"), other, "pointed at the other"});
    int changed = 0;
    for (const auto& [asked, answer] : answersIn(folder))
        if (before.at(asked) != answer) {
            ++changed;
            QCOMPARE(answer, other.value);
        }
    QCOMPARE(changed, 1);
}

void AppOperatorTest::theStoredAnswerIsNoCorrection()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    pressKey(open, Qt::Key_C);
    pressKey(open, Qt::Key_Return);
    const auto stored = answersIn(folder);
    const auto events = [&] { return open.window().study()->store().events(protocols::ParticipantId("P01")).size(); };
    const std::size_t before = events();
    pressKey(open, Qt::Key_L);
    pressKey(open, Qt::Key_C);
    typeText(open, "misheard");
    pressKey(open, Qt::Key_Return);
    QCOMPARE(open.message(), QString("C is the stored answer. Choose another answer, or press Esc to go back."));
    QCOMPARE(events(), before);
    pressKey(open, Qt::Key_A);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(events(), before + 1);
    QVERIFY(answersIn(folder) != stored);
    // A script may hold a correction to the same answer; a replay repeats it.
    const auto now = open.window().session()->correctables().front();
    open.perform(Corrected{now.question, now.response, "misheard"});
    QCOMPARE(events(), before + 2);
}

void AppOperatorTest::stopForNowLeadsBackToTheStudy()
{
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    pressKey(open, Qt::Key_Q);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    QVERIFY(!open.window().session());
    open.window().startSession(protocols::ParticipantId("P01"));
    QVERIFY(open.view().state.paused);
}

void AppOperatorTest::voidedPresentationIsRepeated()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q3");
    const int presentations = open.view().presentations;
    const std::string code = open.view().code.value;
    pressKey(open, Qt::Key_V);
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains(QString::fromStdString(code)));
    typeText(open, "wrong fabric");
    pressKey(open, Qt::Key_Return);
    QCOMPARE(open.view().presentations, presentations + 1);
    QVERIFY(open.view().code.value != code);
    int voided = 0;
    for (const auto& stored : storedIn(folder)) voided += stored.voided ? 1 : 0;
    QCOMPARE(voided, 1);
}

void AppOperatorTest::noteIsStored()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    pressKey(open, Qt::Key_N);
    pressKey(open, Qt::Key_Return);
    pressKey(open, Qt::Key_Return);  // an empty note is never stored
    QVERIFY(!open.message().isEmpty());
    pressKey(open, Qt::Key_Escape);
    QVERIFY(!open.view().state.paused);  // Esc only closed the panel
    open.perform(Noted{"a lorry went by"});
    const auto events = open.window().study()->store().events(protocols::ParticipantId("P01"));
    QVERIFY(events.back().payloadJson.find("a lorry went by") != std::string::npos);
}

void AppOperatorTest::withdrawalNeedsNoReason()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    open.perform(WithdrawnEvent{""});
    QVERIFY(std::holds_alternative<Withdrawn>(open.view().state.stage));
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains("withdrawn"));
    pressKey(open, Qt::Key_Return);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
}

void AppOperatorTest::aWithdrawalAsksForTheCode()
{
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    open.playTo("Presenting");
    pressKey(open, Qt::Key_W);
    pressKey(open, Qt::Key_Return);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("Presenting"));
    QVERIFY2(open.message().contains("Type P01"), qPrintable(open.message()));
    typeText(open, "p1");
    pressKey(open, Qt::Key_Return);
    QVERIFY2(open.message().startsWith("“p1” is not the code of this participant. Type P01"), qPrintable(open.message()));
    pressKey(open, Qt::Key_Escape);
    open.perform(WithdrawnEvent{"tired"});
    QCOMPARE(nameOf(open.view().state), std::string("Withdrawn"));
}

void AppOperatorTest::aBouncedEnterArmsNothing()
{
    OpenWindow open(newStudy({.deadTimeSeconds = 0.7}));
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    pressKey(open, Qt::Key_A);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
    QVERIFY2(open.message().contains("only just"), qPrintable(open.message()));
    open.clock().advanceSeconds(0.7);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("Presenting"));
}

void AppOperatorTest::aWrongPieceIsCaughtBeforeThePresentation()
{
    OpenWindow open(newStudy({.confirmPieces = true, .hasSwatchCodes = true}));
    open.enrolAndBegin();
    const auto scan = [&](const std::string& piece) {
        open.gui().type(QString::fromStdString(piece));
        pressKey(open, Qt::Key_Return);
    };
    const auto tray = open.view().tray;
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
    scan(tray[0]);
    scan(tray[2]);
    QVERIFY2(open.message().contains("is not the piece of slot B"), qPrintable(open.message()));
    scan(tray[1]);
    scan(tray[2]);
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));  // storing the last code is not arming
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("Presenting"));
    open.playToEnd();
}

void AppOperatorTest::theTrayPageSaysWhatToDo_data()
{
    using Tray = std::vector<std::string>;
    QTest::addColumn<Tray>("wanted");
    QTest::addColumn<Tray>("placed");
    QTest::addColumn<QString>("text");
    QTest::newRow("first") << Tray{"1", "2", "3"} << Tray{} << "Put 1 on A · put 2 on B · put 3 on C";
    QTest::newRow("all stay") << Tray{"1", "2", "3"} << Tray{"1", "2", "3"} << "All pieces stay on the tray.";
    QTest::newRow("one of each") << Tray{"829", "663", "11"} << Tray{"795", "829", "11"}
                                 << "Take off 795 · move 829 from B to A · put 663 on B";
    QTest::newRow("a smaller tray") << Tray{"829"} << Tray{"795", "829", "11"} << "Take off 795 · take off 11";
    QTest::newRow("one slot") << Tray{"7"} << Tray{"829"} << "Take off 829 · put 7 on the tray";
}

void AppOperatorTest::theTrayPageSaysWhatToDo()
{
    QFETCH(std::vector<std::string>, wanted);
    QFETCH(std::vector<std::string>, placed);
    QFETCH(QString, text);
    const QString shown = study::app::trayStepsText(study::app::trayStepsTo(wanted, placed), wanted.size());
    QCOMPARE(QString(shown).replace(QChar(QChar::Nbsp), QLatin1Char(' ')), text);
    // A line breaks between two steps only, so that a code stays beside its place.
    if (text.endsWith('.')) return;
    for (const QString& step : shown.split("· ")) QVERIFY2(!step.contains(' '), qPrintable(shown));
}

void AppOperatorTest::theHeaderShowsWhetherAnImageIsFelt()
{
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    const auto shown = [&] { return open.widget<QLabel>("displayFact").text(); };
    QVERIFY2(shown().startsWith("Display off"), qPrintable(shown()));
    open.playTo("Presenting");
    QVERIFY2(shown().startsWith("Display on"), qPrintable(shown()));
    QVERIFY(!open.widget<QLabel>("nextTray").text().isEmpty());
    open.perform(Paused{});
    QVERIFY2(shown().startsWith("Display off"), qPrintable(shown()));
}

void AppOperatorTest::aVoidBeforeAnyAnswerAddsNoAnswer()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting");
    const int inAll = open.view().answersInAll;
    open.perform(Voided{"wrong piece"});
    QCOMPARE(open.view().answersInAll, inAll);
    open.playToEnd();
    QCOMPARE(open.view().answersStored, inAll);
    const database::StudyStore store(folder, database::StudyStore::Access::Read);
    QCOMPARE(store.voidedPresentations().at(protocols::ParticipantId("P01")), 1);
}

/// The header and the guides count as the study page does.
void AppOperatorTest::answersOfAVoidedPresentationAreNotCounted()
{
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    open.playTo("Presenting");
    open.playTo("PlacingTray");
    QCOMPARE(open.widget<QLabel>("answersFact").text(), QString("Answers 1 of 24"));
    open.perform(Voided{"wrong piece"});
    QCOMPARE(open.widget<QLabel>("answersFact").text(), QString("Answers 0 of 24"));
    open.playTo("OnBreak");
    const QString lead = open.widget<QLabel>("pageLead").text();
    QVERIFY2(lead.contains(QStringLiteral("%1 of 24 answers").arg(open.view().answersStored - 1)), qPrintable(lead));
    open.playToEnd();
    QVERIFY2(open.widget<QLabel>("pageLead").text().startsWith("All 24 answers"),
             qPrintable(open.widget<QLabel>("pageLead").text()));
}

void AppOperatorTest::trayMarksOnlyPiecesThatChange()
{
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    const auto marked = [&] {
        QString letters;
        for (const auto* tag : open.window().currentPage()->findChildren<QLabel*>("slotTag"))
            letters += tag->isVisible() && tag->property("role").toString() == QLatin1String("tag-new") ? '1' : '0';
        return letters;
    };
    QCOMPARE(marked(), QString("111"));  // the pieces on the tray are unknown
    for (int presentation = 0; presentation < 3; ++presentation) {
        const auto before = open.view().trayIds;
        open.playTo("Presenting");
        open.playTo("PlacingTray");
        const auto& now = open.view().trayIds;
        QString expected;
        for (std::size_t place = 0; place < now.size(); ++place) expected += now[place] == before[place] ? '0' : '1';
        QCOMPARE(marked(), expected);
    }
}

void AppOperatorTest::heldKeyStoresOneAnswer()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    pressKey(open, Qt::Key_A);
    for (int repeat = 0; repeat < 5; ++repeat) {
        QKeyEvent held(QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier, "\r", repeat > 0);
        QApplication::sendEvent(open.window().focusWidget(), &held);
    }
    QCOMPARE(answersIn(folder).size(), std::size_t(1));
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));  // the held key does not confirm the next tray
}

/// Of six slots, F is one: it must not open the form of a flag while the operator believes that the question is asked.
void AppOperatorTest::everyLetterOfTheTrayComesTooEarly()
{
    OpenWindow open(newStudy({.fabrics = 6, .alternatives = 6}));
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    const auto textOf = [&](const char* button) { return open.widget<QPushButton>(button).text(); };
    QVERIFY2(textOf("flagButton").endsWith("(Alt F)"), qPrintable(textOf("flagButton")));
    open.playTo("PlacingTray");
    QVERIFY2(textOf("flagButton").endsWith("(Alt F)"), qPrintable(textOf("flagButton")));
    QVERIFY2(textOf("noteButton").endsWith("(N)"), qPrintable(textOf("noteButton")));
    const int sent = open.window().session()->eventsSent();
    for (const Qt::Key letter : {Qt::Key_E, Qt::Key_F}) {
        pressKey(open, letter);
        QVERIFY2(open.message().contains("No question is asked yet"), qPrintable(open.message()));
        pressKey(open, Qt::Key_Return);
        QVERIFY2(open.message().contains("Press Enter once more"), qPrintable(open.message()));
    }
    QCOMPARE(open.window().session()->eventsSent(), sent);
    QTest::keyClick(open.window().focusWidget(), Qt::Key_F, Qt::AltModifier);
    QVERIFY2(open.widget<QLabel>("pageTitle").text().startsWith("Flag"), qPrintable(open.widget<QLabel>("pageTitle").text()));
}

void AppOperatorTest::displayFaultPausesAndLosesNothing()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    open.playTo("PlacingTray");
    const auto before = answersIn(folder);
    open.display().fault = "the display is gone";
    pressKey(open, Qt::Key_Return);
    QVERIFY2(open.message().contains("the display is gone"), qPrintable(open.message()));
    QVERIFY2(open.message().contains("plug it in"), qPrintable(open.message()));
    QVERIFY(open.view().state.paused);
    QCOMPARE(answersIn(folder), before);
    open.display().fault.clear();
    pressKey(open, Qt::Key_Return);  // continues the session
    QVERIFY(open.message().isEmpty());
    open.playToEnd();
    QCOMPARE(answersIn(folder).size(), std::size_t(24));
}

void AppOperatorTest::enterStoresNothingBeforeAChoice()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q1");
    pressKey(open, Qt::Key_Return);
    QVERIFY(open.message().contains("No answer is chosen"));
    QVERIFY(answersIn(folder).empty());
    pressKey(open, Qt::Key_B);
    QVERIFY(open.widget<QLabel>("readBack").text().contains("B"));
    pressKey(open, Qt::Key_C);  // changed before it is stored
    const auto third = open.view().trayIds.at(2).value;
    pressKey(open, Qt::Key_Return);
    QCOMPARE(answersIn(folder).begin()->second, third);
}

QTEST_MAIN(AppOperatorTest)
#include "app_operator_test.moc"
