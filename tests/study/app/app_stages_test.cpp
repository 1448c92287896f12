// Stages of a session before, between and after its presentations, through the real widgets.
#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <algorithm>

#include "study/app/state/rating_text.h"
#include "tests/support/played_session.h"
#include "tests/support/typed_answers.h"
#include "tests/support/whole_protocol.h"

using namespace study::session;
using namespace tests::support;
using protocols::ParticipantId;
using protocols::Tenths;

namespace {

bool isFinished(OpenWindow& open) { return std::holds_alternative<Finished>(open.view().state.stage); }

/// Keys that the operator presses at each stage, sent to the widget that has the focus.
struct Keys {
    OpenWindow& open;
    Answers& typed;

    void operator()(const Enrolled&) const { enter(); }
    void operator()(const Consenting&) const { enter(); }
    void operator()(const AskingFacts&) const
    {
        for (const char* fact : {"31", "", "left", ""}) {
            typeText(open, fact);
            enter();  // moves to the next line; on the last line, confirms the page
        }
    }
    void operator()(const Familiarising&) const
    {
        pressKey(open, Qt::Key_1);
        pressKey(open, Qt::Key_2);
        enter();
    }
    void operator()(const ScaleTraining&) const
    {
        if (const auto place = open.view().placeToName) typeText(open, study::app::textOf(*place));
        enter();
    }
    void operator()(const CheckingList&) const
    {
        for (int line = 0; line < 6; ++line) pressKey(open, Qt::Key_Space);
        typeText(open, "21.5");
        enter();
        typeText(open, "40");
        enter();
    }
    void operator()(const PlacingTray&) const { enter(); }
    void operator()(const Presenting&) const
    {
        const GivenAnswer spoken = responseTo(open.view());
        typed[nowAsked(open)] = answerText(spoken);
        answerByKeys(open, spoken);
    }
    void operator()(const OnBreak&) const { enter(); }
    void operator()(const Debriefing&) const
    {
        typeText(open, "It was fun.");
        enter();
    }
    void operator()(const Finished&) const {}
    void operator()(const Withdrawn&) const {}

private:
    void enter() const { pressKey(open, Qt::Key_Return); }
};

}  // namespace

class AppStagesTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void everyStageAndAnswerByKeyboardAlone();
    void factsAreKeptOutsideTheLog();
    void shownFabricIsMarked();
    void scaleTrainingCommentsOnTheDistance_data();
    void scaleTrainingCommentsOnTheDistance();
    void scaleTrainingMayEndAtAnyTime();
    void checklistStoresItsReadingsAndTheTime();
    void everyBreakShowsItsReason();
    void newQuestionsAreNamedWhereASittingEndsBeforeThem();
    void endsOfTheStudysOwnNameTheUsualMaterialsToo();
    void endsOfTheStudysOwnAreSpokenToo();
    void laterSittingOffersItsPreparation();
    void laterSittingMaySkipItsPreparation();
    void killedSessionOffersThePreparationToo();
    void noPreparationIsOfferedIfTheProtocolHasNone();
    void aPreparationNamesOnlyWhatTheProtocolHas();
    void focusedFieldIsVisibleAtDoubleTextSize();
};

void AppStagesTest::everyStageAndAnswerByKeyboardAlone()
{
    const auto folder = newStudy(wholeStudy());
    Answers typed;
    OpenWindow open(folder);
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    pressKey(open, Qt::Key_Return);  // enrols
    for (int steps = 0; !isFinished(open) && steps < 500; ++steps) std::visit(Keys{open, typed}, open.view().state.stage);
    QVERIFY(isFinished(open));
    QCOMPARE(static_cast<int>(typed.size()), answersOf({}));
    QCOMPARE(answersIn(folder), typed);
    for (const auto& stored : storedIn(folder)) QCOMPARE(stored.seconds, 2.0);  // from touch to answer, by the injected clock
    pressKey(open, Qt::Key_Return);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    const auto facts =
        dynamic_cast<database::StudyStore&>(open.window().study()->store()).personalFacts().at(ParticipantId("P01"));
    QCOMPARE(facts, (std::map<std::string, std::string>{{"age", "31"}, {"handedness", "left"}, {debriefingFact, "It was fun."}}));
}

void AppStagesTest::factsAreKeptOutsideTheLog()
{
    OpenWindow open(newStudy(wholeStudy()));
    open.window().startSession(ParticipantId("P01"));
    open.playTo("AskingFacts");
    open.perform(FactsGiven{{{"age", "thirty-one"}}});
    const auto& store = dynamic_cast<const database::StudyStore&>(open.window().study()->store());
    QCOMPARE(store.personalFacts().at(ParticipantId("P01")).at("age"), std::string("thirty-one"));
    for (const auto& event : store.events(ParticipantId("P01")))
        QVERIFY(event.payloadJson.find("thirty-one") == std::string::npos);
}

void AppStagesTest::shownFabricIsMarked()
{
    OpenWindow open(newStudy(wholeStudy()));
    open.window().startSession(ParticipantId("P01"));
    open.playTo("Familiarising");
    open.perform(FamiliarisationShown{1});
    QCOMPARE(open.display().calls.back(), std::string("show"));
    QVERIFY(open.widget<QPushButton>("familiar2").isChecked());
    QVERIFY(!open.widget<QPushButton>("familiar1").isChecked());
    QVERIFY(open.widget<QLabel>("shownFabric").text().contains("known fabric 2"));
    open.perform(FamiliarisationDone{});
    QCOMPARE(open.display().calls.back(), std::string("clear"));
}

void AppStagesTest::scaleTrainingCommentsOnTheDistance_data()
{
    QTest::addColumn<int>("tenthsOff");
    QTest::addColumn<QString>("expectedText");
    QTest::newRow("hit") << 0 << "exactly there";
    QTest::newRow("by half a point") << 5 << "very close";
    QTest::newRow("by almost a point") << -9 << "close, 0.9 too low";
    QTest::newRow("by two points") << 20 << "2 too high";
}

void AppStagesTest::scaleTrainingCommentsOnTheDistance()
{
    QFETCH(int, tenthsOff);
    QFETCH(QString, expectedText);
    OpenWindow open(newStudy(wholeStudy()));
    open.window().startSession(ParticipantId("P01"));
    open.playTo("ScaleTraining");
    // Use the first mark that is far enough from the ends of the scale.
    const auto isOnTheLine = [&](Tenths mark) { return mark.value + tenthsOff >= 0 && mark.value + tenthsOff <= 100; };
    while (!isOnTheLine(open.view().placeToName.value()))
        open.perform(ScalePlaced{*open.view().placeToName, *open.view().placeToName});
    const Tenths shown = *open.view().placeToName;
    open.perform(ScalePlaced{shown, {shown.value + tenthsOff}});
    const QString text = open.widget<QLabel>("deviation").text();
    QVERIFY2(text.contains(expectedText), qPrintable(text));
    QVERIFY(text.contains(study::app::textOf(shown)) || tenthsOff == 0);
}

void AppStagesTest::scaleTrainingMayEndAtAnyTime()
{
    OpenWindow open(newStudy(wholeStudy()));
    open.window().startSession(ParticipantId("P01"));
    open.playTo("ScaleTraining");
    pressKey(open, Qt::Key_Return);
    QVERIFY2(open.message().contains("Press G"), qPrintable(open.message()));
    pressKey(open, Qt::Key_G);
    QCOMPARE(nameOf(open.view().state), std::string("CheckingList"));
}

void AppStagesTest::checklistStoresItsReadingsAndTheTime()
{
    OpenWindow open(newStudy(wholeStudy()));
    open.window().startSession(ParticipantId("P01"));
    open.playTo("CheckingList");
    pressKey(open, Qt::Key_Return);
    QVERIFY2(open.message().contains("not ticked yet"), qPrintable(open.message()));
    QCOMPARE(nameOf(open.view().state), std::string("CheckingList"));
    open.perform(ChecklistDone{open.gui().plan().protocol.checklist, {{"temperature in °C", "22.5"}}});
    const auto last = open.window().study()->store().events(ParticipantId("P01")).back();
    QCOMPARE(last.kind, std::string("checklist_done"));
    QVERIFY(last.payloadJson.find("eye mask") != std::string::npos);
    QVERIFY(last.payloadJson.find("\"22.5\"") != std::string::npos);  // every lab's readings have a point
    QVERIFY(!last.wallTime.empty());
}

void AppStagesTest::everyBreakShowsItsReason()
{
    OpenWindow open(newStudy(wholeStudy()));
    open.enrolAndBegin();
    const auto lead = [&] { return open.widget<QLabel>("pageTitle").text() + ' ' + open.widget<QLabel>("pageLead").text(); };
    open.playTo("OnBreak");
    QVERIFY(std::get<OnBreak>(open.view().state.stage).reason == BreakReason::Block);
    QVERIFY2(lead().startsWith("Break "), qPrintable(lead()));
    open.perform(BreakEnded{});
    open.playTo("OnBreak");
    QVERIFY(std::get<OnBreak>(open.view().state.stage).reason == BreakReason::Phase);
    QVERIFY2(lead().contains("new questions") && lead().contains("S1"), qPrintable(lead()));
    open.perform(BreakEnded{});
    open.clock().advanceSeconds(75 * 60);
    open.playTo("OnBreak");
    QVERIFY(std::get<OnBreak>(open.view().state.stage).reason == BreakReason::SittingOver);
    QVERIFY2(lead().contains("another day") && lead().contains("lasted"), qPrintable(lead()));
    open.gui().click("secondButton");  // stop here for today
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
}

void AppStagesTest::newQuestionsAreNamedWhereASittingEndsBeforeThem()
{
    const auto folder = newStudy(wholeStudy());
    const auto shows = [](OpenWindow& open, const QString& text) {
        const auto labels = open.window().currentPage()->findChildren<QLabel*>();
        return std::any_of(labels.begin(), labels.end(),
                           [&](const QLabel* label) { return label->isVisible() && label->text().contains(text); });
    };
    const QString questions = "Questions that follow: S1. Explain them before the participant puts the mask on.";
    {
        OpenWindow open(folder);
        open.enrolAndBegin();
        while (open.view().presentation < 6 || nameOf(open.view().state) != "Presenting") open.perform(open.nextEvent());
        QVERIFY(!shows(open, questions));
        open.clock().advanceSeconds(75 * 60);
        open.playTo("OnBreak");
        QVERIFY(std::get<OnBreak>(open.view().state.stage).reason == BreakReason::SittingOver);
        QVERIFY(shows(open, questions) && shows(open, "continue on another day"));
        open.window().close();
    }
    OpenWindow open(folder);
    open.window().startSession(ParticipantId("P01"));
    QVERIFY(shows(open, "Welcome back") && shows(open, questions));
    pressKey(open, Qt::Key_G);
    QCOMPARE(nameOf(open.view().state), std::string("OnBreak"));
    QVERIFY(shows(open, "Break: new questions follow") && shows(open, questions));
    QVERIFY(!shows(open, "This sitting has lasted") && !shows(open, "A tired hand"));
    open.perform(BreakEnded{});
    open.playTo("Presenting", "S1");
}

/// A text of the study may be a translation, or name other materials: the operator reads both.
void AppStagesTest::endsOfTheStudysOwnNameTheUsualMaterialsToo()
{
    StudyRecipe recipe = wholeStudy();
    recipe.protocol.insert(recipe.protocol.find('{') + 1,
                           R"("participant_texts": {"card_low": "{number} is the roughest of all."}, )");
    OpenWindow open(newStudy(recipe));
    open.window().startSession(ParticipantId("P01"));
    open.playTo("ScaleTraining");
    const QString low = open.widget<QLabel>("lowAnchor").text();
    QVERIFY2(low.contains("your materials (usually sandpaper, then silk)"), qPrintable(low));
    QVERIFY2(low.endsWith("Say: “0 is the roughest of all.”"), qPrintable(low));
    QVERIFY(open.widget<QLabel>("highAnchor").text().startsWith("Let the participant touch two pieces of the same fabric."));
}

void AppStagesTest::endsOfTheStudysOwnAreSpokenToo()
{
    StudyRecipe recipe = wholeStudy();
    recipe.protocol.insert(recipe.protocol.find('{') + 1,
                           R"("participant_texts": {"scale_low": "rough as bark", "scale_high": "smooth as glass"}, )");
    const auto folder = newStudy(recipe);
    {
        OpenWindow open(folder);
        open.window().startSession(ParticipantId("P01"));
        open.playTo("ScaleTraining");
        const auto &low = open.widget<QLabel>("lowAnchor"), &high = open.widget<QLabel>("highAnchor");
        QVERIFY2(low.text().endsWith("Say: “0 rough as bark”"), qPrintable(low.text()));
        QVERIFY2(high.text().endsWith("Say: “10 smooth as glass”"), qPrintable(high.text()));
        for (const QLabel* end : {&low, &high}) QCOMPARE(end->alignment() & Qt::AlignVertical_Mask, Qt::Alignment(Qt::AlignTop));
        open.playTo("Presenting", "S1");
        open.window().close();
    }
    OpenWindow open(folder);
    open.window().startSession(ParticipantId("P01"));
    pressKey(open, Qt::Key_Return);
    const QString lead = open.widget<QLabel>("pageLead").text();
    QVERIFY2(lead.contains("Say: “0 rough as bark, 10 smooth as glass”"), qPrintable(lead));
}

void AppStagesTest::laterSittingOffersItsPreparation()
{
    const auto folder = newStudy(wholeStudy());
    {
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.playTo("Presenting", "S1");
        open.window().close();
    }
    OpenWindow open(folder);
    open.window().startSession(ParticipantId("P01"));
    QVERIFY(open.view().state.paused);
    pressKey(open, Qt::Key_Return);
    QCOMPARE(nameOf(open.view().state), std::string("ScaleTraining"));
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains("Repeat the scale"));
    QVERIFY(!open.window().findChild<QLabel*>("lowAnchor")->isVisible());
    QVERIFY(open.view().placeToName);
    open.playTo("CheckingList");
    QVERIFY(!open.widget<QAbstractButton>("check1").isChecked());  // every sitting starts without ticks
    open.playTo("PlacingTray");
    QVERIFY(open.view().sittingIsPrepared);
    open.playToEnd();
    QCOMPARE(static_cast<int>(answersIn(folder).size()), answersOf({}));
}

void AppStagesTest::laterSittingMaySkipItsPreparation()
{
    const auto folder = newStudy(wholeStudy());
    {
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.window().close();
    }
    OpenWindow open(folder);
    open.window().startSession(ParticipantId("P01"));
    pressKey(open, Qt::Key_G);
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
    QVERIFY(open.widget<QPushButton>("trayReadyButton").isVisible());
    open.perform(Paused{});
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains("Paused"));  // not offered twice
    open.playTo("Presenting");
}

void AppStagesTest::killedSessionOffersThePreparationToo()
{
    const auto folder = newStudy(wholeStudy());
    {
        OpenSession killed(folder, "P01", database::ParticipantKind::Human);
        killed.stepUntil("PlacingTray");
    }
    OpenWindow open(folder);
    open.window().startSession(ParticipantId("P01"));
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains("Welcome back"));
    QVERIFY(open.widget<QLabel>("pageLead").text().endsWith("First repeat the scale and the checklist."));
    const int events = open.window().session()->eventsSent();
    pressKey(open, Qt::Key_G);
    QCOMPARE(open.window().session()->eventsSent(), events);  // the engine is already at the tray
    QVERIFY(open.widget<QPushButton>("trayReadyButton").isVisible());
}

void AppStagesTest::noPreparationIsOfferedIfTheProtocolHasNone()
{
    const std::string protocol = R"({"schema": "vis2hap.protocol/1", "name": "Bare study", "participants": 1,
        "fabrics": ["F01", "F02", "F03"], "conditions": ["v_grey", "h&f"],
        "phases": [{"questions": ["Q1"], "alternatives": 3}]})";
    const auto folder = newStudy({.protocol = protocol});
    {
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.window().close();
    }
    OpenWindow open(folder);
    open.window().startSession(ParticipantId("P01"));
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains("Paused"));
    pressKey(open, Qt::Key_Return);  // the Enter that opened the session bounces
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains("Paused"));
    open.clock().advanceSeconds(1);
    pressKey(open, Qt::Key_Return);
    QVERIFY(open.widget<QPushButton>("trayReadyButton").isVisible());
}

void AppStagesTest::aPreparationNamesOnlyWhatTheProtocolHas()
{
    const auto folder = newStudy();  // ratings, and no checklist
    {
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.window().close();
    }
    OpenWindow open(folder);
    open.window().startSession(ParticipantId("P01"));
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains("Welcome back"));
    QVERIFY2(open.widget<QLabel>("pageLead").text().endsWith("First repeat the scale."),
             qPrintable(open.widget<QLabel>("pageLead").text()));
    pressKey(open, Qt::Key_G);
    open.playTo("OnBreak");
    while (std::get<OnBreak>(open.view().state.stage).reason != BreakReason::Phase) {
        open.perform(BreakEnded{});
        open.playTo("OnBreak");
    }
    QVERIFY2(open.widget<QLabel>("pageLead").text().startsWith("Questions that follow: Q2–Q4."),
             qPrintable(open.widget<QLabel>("pageLead").text()));
}

void AppStagesTest::focusedFieldIsVisibleAtDoubleTextSize()
{
    OpenWindow open(newStudy(wholeStudy()));
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    open.window().setAppearance({study::app::Theme::Light, 200});
    open.window().resize(1100, 750);
    open.window().startSession(ParticipantId("P01"));
    for (int steps = 0; !isFinished(open) && steps < 120; ++steps) {
        const QWidget* focus = QApplication::focusWidget();
        if (focus && focus->testAttribute(Qt::WA_InputMethodEnabled))
            QTRY_VERIFY2_WITH_TIMEOUT(focus->visibleRegion().boundingRect().height() >= std::min(focus->height(), 60),
                                      nameOf(open.view().state).c_str(), 500);
        open.perform(open.nextEvent());
    }
}

QTEST_MAIN(AppStagesTest)
#include "app_stages_test.moc"
