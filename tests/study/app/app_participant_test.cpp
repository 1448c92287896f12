// A session in the window with the participant's own screen: a tablet's browser, and a window on a second screen. What the
// participant does reaches the session, the operator sees it and keeps control, and the session never needs the screen.
#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QTest>
#include <csignal>
#include <fstream>

#include "study/app/participant/participant_side.h"
#include "study/app/participant/participant_sound.h"
#include "study/app/pieces/scale_line.h"
#include "study/app/state/rating_text.h"
#include "tests/support/browser.h"
#include "tests/support/counting_vfs.h"
#include "tests/support/open_window.h"
#include "tests/support/whole_protocol.h"

using namespace study::session;
using protocols::ParticipantId;
using study::app::PageState;
using study::app::ParticipantSide;
using tests::support::Answer;
using tests::support::Browser;
using tests::support::OpenWindow;

namespace {

/// A session with a browser that has entered the code.
struct TabletSession {
    OpenWindow open;
    std::unique_ptr<Browser> tablet;

    explicit TabletSession(const database::StudyFolder& study, bool begins = true) : open(study)
    {
        side().startPage("127.0.0.1");
        if (!QTest::qWaitFor([this] { return !side().state().address.isEmpty(); }, 10000)) qFatal("the page does not listen");
        tablet = std::make_unique<Browser>(side().state().address.mid(7));
        if (tablet->enter(side().state().code.toLatin1()).status != 204) qFatal("the code is refused");
        if (begins) open.window().startSession(ParticipantId("P01"));
    }
    ParticipantSide& side() { return open.window().participantSide(); }
    /// What the tablet shows, after the app had time to send it.
    QByteArray shown()
    {
        QTest::qWait(60);
        return tablet->get("/now").body;
    }
    int number() { return shown().mid(shown().indexOf("\"number\":") + 9).split(',').front().toInt(); }
    int act(const QByteArray& members)
    {
        const int status = tablet->post("/act", "{\"number\":" + QByteArray::number(number()) + "," + members + "}").status;
        QTest::qWait(60);
        return status;
    }
    /// The operator's keys hold for 0.7 s after the participant has moved the session on.
    void waitForKeys() { QTest::qWait(750); }
    std::string stage() { return nameOf(open.view().state); }
};

}  // namespace

class AppParticipantTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void aParticipantAgreesAnswersAndLearnsTheScaleOnATablet();
    void theTabletShowsNothingOfPresentations();
    void whoDoesNotAgreeIsTheOperatorsDecision();
    void aDisagreementStandsBesideAnOpenPanelAndAfterIt();
    void aConsentAfterADisagreementIsAskedForTwice();
    void aLateTapChangesNothing();
    void theOperatorsKeysHoldForAMoment();
    void aPanelOfTheOperatorStaysOpen();
    void anAgreementThatIsNotStoredIsNotConfirmed();
    void theSessionGoesOnWithoutThePage();
    void aKilledPageComesBackAndKnowsTheTablet();
    void thePageNamesAddressCodeAndGuests();
    void theSecondScreenShowsTheSame();
    void f4LeadsThereAndBack();
    void theClockOfABreakGoesOnBehindF4();
    void wordsAndRecordingsAreThoseOfTheOpenStudy();
    void promptsAreDueAtTheirMoments();
    void theHeadphonesKeepTheVersionOfTheParticipant();
    void aRecordingWinsOverSpeech();
    void aNumberIsReadBackWholeOrNotAtAll();
    void withoutSoundThePageSaysSo();
    void soundThatEndsInMidSessionIsShown();
    void helperProgramsGetNoSecretOfTheOwner();
};

void AppParticipantTest::aParticipantAgreesAnswersAndLearnsTheScaleOnATablet()
{
    const auto study = newStudy(tests::support::wholeStudy());
    TabletSession session(study);
    QVERIFY(session.shown().contains("Welcome"));
    session.open.perform(Begun{});
    QVERIFY(session.shown().contains("They have agreed to take part."));
    QCOMPARE(session.act("\"agrees\":true"), 204);
    QCOMPARE(session.stage(), std::string("AskingFacts"));
    QVERIFY2(session.open.message().contains("agreed on their own screen"), qPrintable(session.open.message()));
    QVERIFY(session.shown().contains("handedness"));
    QCOMPARE(session.act(R"("facts":["31","","left",""])"), 204);
    QCOMPARE(session.stage(), std::string("Familiarising"));
    session.waitForKeys();
    session.open.perform(FamiliarisationDone{});
    for (const int tenthsOff : {0, 0, 30, 0, 0, 0}) {
        const int place = session.open.view().placeToName.value().value;
        const int named = place + (place + tenthsOff <= 100 ? tenthsOff : -tenthsOff);
        QCOMPARE(session.act("\"tapped\":" + QByteArray::number(named)), 204);
        QVERIFY(session.open.widget<QLabel>("deviation").text().contains(study::app::textOf(protocols::Tenths{named})));
    }
    QVERIFY(!session.open.view().placeToName);
    QVERIFY2(session.shown().contains("You know the scale now."), session.shown().constData());
    session.waitForKeys();
    session.open.perform(ScaleTrainingDone{});
    QVERIFY(session.shown().contains("blindfold"));
    session.open.playToEnd();
    QVERIFY(session.shown().contains("The session is over."));
    const auto& store = dynamic_cast<const database::StudyStore&>(session.open.window().study()->store());
    QCOMPARE(static_cast<int>(store.answers().size()), tests::support::answersOf({}));
    int byParticipant = 0;
    for (const auto& event : store.events(ParticipantId("P01")))
        byParticipant += event.payloadJson.find("\"by\":\"participant\"") != std::string::npos;
    QCOMPARE(byParticipant, 8);
}

void AppParticipantTest::theTabletShowsNothingOfPresentations()
{
    TabletSession session(newStudy(tests::support::wholeStudy()));
    session.open.playTo("Presenting");
    std::set<QByteArray> seen;
    for (int step = 0; step < 14; ++step) {
        const QByteArray shown = session.shown();
        for (const std::string& piece : session.open.view().tray) QVERIFY(!shown.contains(piece.c_str()));
        if (const auto& code = session.open.view().code.value; !code.empty()) QVERIFY(!shown.contains(code.c_str()));
        if (session.stage() != "OnBreak") seen.insert(shown.mid(shown.indexOf("instruction")));
        session.open.perform(session.open.nextEvent());
    }
    QCOMPARE(seen.size(), std::size_t(2));  // wait, feel
}

void AppParticipantTest::whoDoesNotAgreeIsTheOperatorsDecision()
{
    TabletSession session(newStudy(tests::support::wholeStudy()));
    session.open.perform(Begun{});
    QCOMPARE(session.act("\"agrees\":false"), 204);
    QCOMPARE(session.stage(), std::string("Consenting"));
    QVERIFY2(session.open.message().contains("does not agree"), qPrintable(session.open.message()));
    const auto last = session.open.window().study()->store().events(ParticipantId("P01")).back();
    QCOMPARE(last.kind, std::string("noted"));
    QVERIFY2(last.payloadJson.find("do not agree") != std::string::npos, last.payloadJson.c_str());
    QCOMPARE(session.act("\"agrees\":true"), 204);  // after a talk
    QCOMPARE(session.stage(), std::string("AskingFacts"));
}

void AppParticipantTest::aDisagreementStandsBesideAnOpenPanelAndAfterIt()
{
    TabletSession session(newStudy(tests::support::wholeStudy()));
    session.open.perform(Begun{});
    const auto isShown = [&] {
        const auto* bar = session.open.window().currentPage()->findChild<QLabel*>("sessionMessage");
        return session.open.message().startsWith("The participant does not agree.") && bar->property("role") == "fault";
    };
    session.open.gui().click("noteButton");
    session.open.gui().type("half a no");
    QCOMPARE(session.act("\"agrees\":false"), 204);
    QVERIFY2(isShown() && !session.open.message().contains("stored"), qPrintable(session.open.message()));
    session.open.gui().pressKey(Qt::Key_Escape);
    QTRY_VERIFY2(isShown(), qPrintable(session.open.message()));
    session.open.gui().click("noteButton");
    QTRY_VERIFY2(isShown(), qPrintable(session.open.message()));
    session.open.gui().type("They hesitate.");
    session.open.gui().pressKey(Qt::Key_Return);
    QTRY_VERIFY2(isShown() && session.open.message().endsWith("The note is stored."), qPrintable(session.open.message()));
    QCOMPARE(session.act("\"agrees\":true"), 204);
    QCOMPARE(session.open.message(), QString("The participant agreed on their own screen."));
}

void AppParticipantTest::aConsentAfterADisagreementIsAskedForTwice()
{
    auto recipe = tests::support::wholeStudy();
    recipe.protocol =
        QString::fromStdString(recipe.protocol).replace("\"dead_time_seconds\": 0,", "\"dead_time_seconds\": 0.7,").toStdString();
    TabletSession session(newStudy(recipe));
    session.open.perform(Begun{});
    const auto enterAfter = [&](double seconds) {
        session.open.clock().advanceSeconds(seconds);
        session.open.gui().pressKey(Qt::Key_Return);
        return session.stage();
    };
    session.act("\"agrees\":false");
    QCOMPARE(enterAfter(1), std::string("Consenting"));
    QVERIFY2(session.open.message().endsWith("press Enter once more."), qPrintable(session.open.message()));
    session.act("\"agrees\":false");  // and they say it again
    QCOMPARE(enterAfter(1), std::string("Consenting"));
    QCOMPARE(enterAfter(0), std::string("Consenting"));  // this Enter bounced
    QCOMPARE(enterAfter(1), std::string("AskingFacts"));
    QCOMPARE(session.open.message(), QString());
}

void AppParticipantTest::aLateTapChangesNothing()
{
    TabletSession session(newStudy(tests::support::wholeStudy()));
    session.open.perform(Begun{});
    const int consent = session.number();
    session.open.perform(Consented{});  // the operator was faster
    QCOMPARE(session.stage(), std::string("AskingFacts"));
    session.shown();
    QCOMPARE(session.tablet->post("/act", "{\"number\":" + QByteArray::number(consent) + ",\"agrees\":true}").status, 409);
    QCOMPARE(session.act("\"agrees\":true"), 400);
    QCOMPARE(session.act("\"facts\":[\"1\"]"), 400);  // fewer than the questions
    QCOMPARE(session.stage(), std::string("AskingFacts"));
}

void AppParticipantTest::theOperatorsKeysHoldForAMoment()
{
    TabletSession session(newStudy(tests::support::wholeStudy()));
    session.open.playTo("AskingFacts");
    const int number = session.number();
    session.tablet->post("/act", "{\"number\":" + QByteArray::number(number) + R"(,"facts":["","","",""]})");
    QTRY_COMPARE(session.stage(), std::string("Familiarising"));
    session.open.gui().pressKey(Qt::Key_Return);  // meant for the page of the facts
    QCOMPARE(session.stage(), std::string("Familiarising"));
    session.waitForKeys();
    session.open.gui().pressKey(Qt::Key_Return);
    QCOMPARE(session.stage(), std::string("ScaleTraining"));
}

void AppParticipantTest::aPanelOfTheOperatorStaysOpen()
{
    TabletSession session(newStudy(tests::support::wholeStudy()));
    session.open.perform(Begun{});
    session.open.gui().click("noteButton");
    session.open.gui().type("nervous");
    QCOMPARE(session.act("\"agrees\":false"), 204);
    QCOMPARE(session.act("\"agrees\":true"), 204);
    QCOMPARE(session.stage(), std::string("AskingFacts"));
    session.open.gui().pressKey(Qt::Key_Return);
    const auto last = session.open.window().study()->store().events(ParticipantId("P01")).back();
    QCOMPARE(last.kind, std::string("noted"));
    QVERIFY(last.payloadJson.find("nervous") != std::string::npos);
}

void AppParticipantTest::anAgreementThatIsNotStoredIsNotConfirmed()
{
    const auto study = newStudy(tests::support::wholeStudy());
    tests::support::CountingVfs disk;
    TabletSession session(study);
    session.open.perform(Begun{});
    disk.letWritesFailWith(SQLITE_FULL);
    session.act("\"agrees\":true");
    QCOMPARE(session.stage(), std::string("Consenting"));
    QVERIFY2(session.open.message().contains("disk is full"), qPrintable(session.open.message()));
    session.act("\"agrees\":false");
    QVERIFY2(session.open.message().contains("does not agree"), qPrintable(session.open.message()));
    disk.letWritesFailWith(SQLITE_OK);
    session.act("\"agrees\":true");
    QCOMPARE(session.stage(), std::string("AskingFacts"));
    QVERIFY2(session.open.message().contains("agreed on their own screen"), qPrintable(session.open.message()));
}

void AppParticipantTest::theSessionGoesOnWithoutThePage()
{
    TabletSession session(newStudy(tests::support::wholeStudy()));
    session.open.playTo("AskingFacts");
    session.side().stopPage();
    QCOMPARE(session.tablet->get("/now").status, 0);
    session.open.playToEnd();
    QCOMPARE(session.stage(), std::string("Finished"));
}

void AppParticipantTest::aKilledPageComesBackAndKnowsTheTablet()
{
    TabletSession session(newStudy(tests::support::wholeStudy()));
    session.open.playTo("Consenting");
    const QString address = session.side().state().address;
    ::kill(static_cast<pid_t>(session.side().pageProcessId()), SIGKILL);
    QTRY_VERIFY(session.side().state().fault.contains("has stopped"));
    QTRY_VERIFY(session.side().state().fault.isEmpty());
    QTRY_COMPARE(session.tablet->get("/now").status, 200);
    QCOMPARE(session.side().state().address, address);
    QVERIFY(session.shown().contains("They have agreed"));
    QCOMPARE(session.act("\"agrees\":true"), 204);
    QCOMPARE(session.stage(), std::string("AskingFacts"));
}

void AppParticipantTest::thePageNamesAddressCodeAndGuests()
{
    OpenWindow open(newStudy());
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    open.gui().pressKey(Qt::Key_F4);
    QCOMPARE(open.window().currentPage()->objectName(), QString("participantPage"));
    open.gui().click("startPageButton");
    const auto text = [&](const char* name) { return open.widget<QLabel>(name).text(); };
    QTRY_VERIFY(open.window().currentPage()->findChild<QLabel*>("pageAddress")->isVisible());
    QVERIFY(text("pageAddress").startsWith("http://127.0.0.1:"));
    const QString code = text("pageCode").section(": ", 1).remove(' ');
    QCOMPARE(code.size(), 6);
    Browser tablet(text("pageAddress").mid(7));
    for (int tries = 1; tries <= 2; ++tries) QCOMPARE(tablet.enter("x").status, 403);
    QTRY_VERIFY2(text("pageState").contains("Wrong codes: 2"), qPrintable(text("pageState")));
    QCOMPARE(tablet.enter(code.toLatin1()).status, 204);
    QTRY_VERIFY2(text("pageState").contains("A browser at 127.0.0.1 shows the page"), qPrintable(text("pageState")));
    QVERIFY(!open.window().currentPage()->findChild<QLabel*>("pageCode")->isVisible());
    open.gui().click("newCodeButton");
    QVERIFY(text("pageCode").section(": ", 1).remove(' ') != code);
    QTRY_COMPARE(tablet.get("/now").status, 401);
    open.gui().click("startPageButton");  // stops it
    QCOMPARE(tablet.get("/now").status, 0);
    QVERIFY(open.widget<QComboBox>("networkChoice").itemText(0).contains("This computer only"));
}

void AppParticipantTest::theSecondScreenShowsTheSame()
{
    OpenWindow open(newStudy(tests::support::wholeStudy()));
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    open.gui().pressKey(Qt::Key_F4);
    open.gui().click("openWindowButton");
    open.gui().pressKey(Qt::Key_Escape);
    const auto window = [] {
        for (QWidget* one : QApplication::topLevelWidgets())
            if (one->objectName() == "participantWindow" && one->isVisible()) return one;
        return static_cast<QWidget*>(nullptr);
    };
    QVERIFY(window());
    const auto text = [&](const char* name) { return window()->findChild<QLabel*>(name)->text(); };
    const QString pictures = qEnvironmentVariable("VIS2HAP_SCREENSHOTS");
    const auto look = [&](const char* page) {
        window()->resize(1280, 800);
        QTest::qWait(20);
        const auto cut = [&] {
            QStringList names;
            for (const QLabel* label : window()->findChildren<QLabel*>())
                if (label->isVisible() && label->height() < label->heightForWidth(label->width())) names << label->objectName();
            return names.join(' ');
        };
        QTRY_VERIFY2_WITH_TIMEOUT(cut().isEmpty(), qPrintable(page + QString(": ") + cut()), 1000);
        if (!pictures.isEmpty()) window()->grab().save(pictures + "/second-screen-" + page + ".png");
    };
    open.window().startSession(ParticipantId("P01"));
    look("welcome");
    open.perform(Begun{});
    look("consent");
    QVERIFY(text("participantStatement").contains("They have agreed to take part."));
    open.playTo("AskingFacts");
    look("facts");
    open.playTo("ScaleTraining");
    const auto* line = window()->findChild<study::app::ScaleLine*>();
    QVERIFY(line->isVisible() && line->rating() == open.view().placeToName);
    QCOMPARE(text("participantQuestion"), QString("Which number belongs to the mark? Say it."));
    open.perform(ScalePlaced{*open.view().placeToName, *open.view().placeToName});
    QCOMPARE(text("participantCount"), QString("1 of 3 right in a row"));
    look("scale");
    open.playTo("Presenting");
    QCOMPARE(text("participantTitle"), QString("Feel the display"));
    QVERIFY(!line->isVisible());
    look("feel");
    open.playTo("OnBreak");
    look("break");
    QVERIFY2(text("participantClock").startsWith("The break has lasted 0:0"), qPrintable(text("participantClock")));
    open.window().close();
    QVERIFY(!window());
}

void AppParticipantTest::f4LeadsThereAndBack()
{
    OpenWindow open(newStudy(tests::support::wholeStudy()));
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    open.gui().pressKey(Qt::Key_F4);
    QCOMPARE(open.window().currentPage()->objectName(), QString("participantPage"));
    open.gui().pressKey(Qt::Key_F4);
    QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    open.enrolAndBegin();
    open.gui().pressKey(Qt::Key_F4);
    QCOMPARE(open.window().currentPage()->objectName(), QString("participantPage"));
    open.gui().pressKey(Qt::Key_Escape);
    QCOMPARE(open.window().currentPage()->objectName(), QString("sessionPage"));
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));  // Esc paused nothing
    open.perform(open.nextEvent());
}

void AppParticipantTest::theClockOfABreakGoesOnBehindF4()
{
    OpenWindow open(newStudy());
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    open.enrolAndBegin();
    open.playTo("OnBreak");
    open.clock().advanceSeconds(190);
    open.gui().pressKey(Qt::Key_F4);
    open.gui().pressKey(Qt::Key_F4);
    QCOMPARE(open.window().currentPage()->objectName(), QString("sessionPage"));
    const QString clock = open.widget<QLabel>("breakClock").text();
    QVERIFY2(clock.contains("3:1"), qPrintable(clock));
}

/// The tablet usually enters before the first session.
void AppParticipantTest::wordsAndRecordingsAreThoseOfTheOpenStudy()
{
    auto recipe = tests::support::wholeStudy({.language = "de"});
    recipe.protocol.insert(1, R"("prompts": {"wait": "w.wav", "feel": "f.wav"}, "participant_texts": {"agree": "Ja, gern"},)");
    const auto study = newStudy(recipe);
    TabletSession session(study, false);
    QVERIFY(QTest::qWaitForWindowActive(&session.open.window()));
    const auto words = [&] {
        QTest::qWait(60);
        return session.tablet->get("/words").body;
    };
    const QByteArray german = words();
    QVERIFY2(german.contains("\"language\":\"de\"") && german.contains("\"agree\":\"Ja, gern\""), german.constData());
    session.open.gui().pressKey(Qt::Key_F4);
    QCOMPARE(session.open.widget<QLabel>("soundState").text(), QString("Recordings of the study: 2."));
    session.open.gui().pressKey(Qt::Key_F4);
    session.open.gui().click("closeStudyButton");
    QVERIFY(words().contains("\"language\":\"en\""));
    QCOMPARE(session.open.window().participantSound().state().recordings, 0);
    session.open.window().openStudy(study.folder);
    QCOMPARE(words(), german);
    session.open.window().startSession(ParticipantId("P01"));
    QCOMPARE(words(), german);
}

void AppParticipantTest::promptsAreDueAtTheirMoments()
{
    OpenWindow open(newStudy(tests::support::wholeStudy()));
    std::vector<std::string> due;
    connect(&open.window().participantSound(), &study::app::ParticipantSound::due, this,
            [&](const std::vector<std::string>& keys) { due = keys; });
    open.enrolAndBegin();
    QVERIFY(due.empty());
    open.perform(open.nextEvent());
    QVERIFY(due == (std::vector<std::string>{"feel", "question_Q1"}));
    open.perform(Touched{});
    open.perform(Answered{open.view().trayIds[1]});
    QVERIFY(due == (std::vector<std::string>{"answer_B", "question_W1"}));
}

void AppParticipantTest::theHeadphonesKeepTheVersionOfTheParticipant()
{
    const auto study = newStudy(tests::support::wholeStudy());
    {
        OpenWindow open(study);
        open.window().startSession(ParticipantId("P01"));
    }
    const std::string amended =
        QString::fromStdString(tests::support::wholeProtocolText()).replace("in your own words?", "in two words?").toStdString();
    std::ofstream(study.protocol(), std::ios::binary) << amended;
    database::StudyStore(study, database::StudyStore::Access::Write).takeProtocol(amended, "Ada", "shorter answers");
    OpenWindow open(study);
    const auto said = [&](const char* participant) {
        open.window().startSession(ParticipantId(participant));
        return QString::fromStdString(open.window().participantSound().prompts().texts.at("question_W1"));
    };
    QVERIFY(said("P02").endsWith("in two words?"));
    QVERIFY(said("P01").endsWith("in your own words?"));
}

void AppParticipantTest::aRecordingWinsOverSpeech()
{
    using namespace study::participant;
    const study::app::SaidPrompts prompts{{{"feel", "/f.wav"}}, {{"feel", "Feel"}, {"question_Q1", "Which?"}}, "en"};
    const std::vector<std::string> keys{"feel", "question_Q1", "answer_B"};
    const auto played = [&](bool hasVoice) { return study::app::playedFor(keys, prompts, hasVoice).prompts; };
    QVERIFY(played(true) == (std::vector<Prompt>{Recording{"/f.wav"}, SpokenText{"Which?"}}));
    QVERIFY(played(false) == std::vector<Prompt>{Recording{"/f.wav"}});
}

/// Half a number is another number.
void AppParticipantTest::aNumberIsReadBackWholeOrNotAtAll()
{
    using namespace study::participant;
    using study::app::CutNumber;
    study::app::SaidPrompts prompts{{}, {{"point", "point"}, {"number_7", "7"}}, "en"};
    for (int number = 0; number <= 10; ++number)
        prompts.files["number_" + std::to_string(number)] = "/" + std::to_string(number) + ".wav";
    prompts.files["wait"] = "/w.wav";
    using Keys = std::vector<std::string>;
    const auto played = [&](const Keys& keys, bool hasVoice) { return study::app::playedFor(keys, prompts, hasVoice).prompts; };
    const auto cut = [&](const Keys& keys, bool hasVoice) { return study::app::cutNumberIn(keys, prompts, hasVoice); };
    const Keys fiveFour{"number_5", "point", "number_4", "wait"}, high{"number_150", "point", "number_5", "wait"};
    const Prompt wait = Recording{"/w.wav"};
    // Recordings of numbers, none of the point.
    QVERIFY(played(fiveFour, false) == std::vector<Prompt>{wait});
    QVERIFY(cut(fiveFour, false) == (CutNumber{protocols::Tenths{54}, "point"}));
    QVERIFY(played({"number_5", "wait"}, false) == (std::vector<Prompt>{Recording{"/5.wav"}, wait}));
    QVERIFY(!cut({"number_5", "wait"}, false));
    // A voice for the point.
    const Together whole{{Recording{"/5.wav"}, SpokenText{"point"}, Recording{"/4.wav"}}};
    QVERIFY(played(fiveFour, true) == (std::vector<Prompt>{whole, wait}));
    QVERIFY(!cut(fiveFour, true));
    // No number above 10.
    for (const bool hasVoice : {true, false}) QVERIFY(played(high, hasVoice) == std::vector<Prompt>{wait});
    QVERIFY(cut(high, true) == (CutNumber{protocols::Tenths{1505}, "number_150"}));
    // Nothing for numbers at all is what the page of the headphones says before.
    std::erase_if(prompts.files, [](const auto& file) { return file.first != "wait"; });
    QVERIFY(played(fiveFour, false) == std::vector<Prompt>{wait});
    QVERIFY(!cut(fiveFour, false));
}

void AppParticipantTest::withoutSoundThePageSaysSo()
{
    OpenWindow open(newStudy());
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    open.gui().pressKey(Qt::Key_F4);
    const auto text = [&] { return open.widget<QLabel>("soundState").text(); };
    QVERIFY2(text().contains("names no recordings"), qPrintable(text()));
    open.gui().click("startSoundButton");
    // A computer with an output plays; one without says what is missing. Neither holds the session up.
    QTRY_VERIFY2(text().startsWith("Playing on") || open.message("participantMessage").contains("no output for sound"),
                 qPrintable(open.message("participantMessage")));
    open.gui().pressKey(Qt::Key_Escape);
    open.enrolAndBegin();
    open.playToEnd();
}

void AppParticipantTest::soundThatEndsInMidSessionIsShown()
{
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    auto& sound = open.window().participantSound();
    sound.start(0.08, study::app::Speech::RecordingsOnly);
    // Without an output the program ends by itself; else it is killed while it plays.
    QTRY_VERIFY(!sound.state().isOn || !sound.state().device.isEmpty());
    if (sound.state().isOn) ::kill(static_cast<pid_t>(sound.processId()), SIGKILL);
    QTRY_VERIFY(!sound.state().isOn);
    const QString message = open.message();
    QVERIFY2(message.startsWith("The sound has stopped: ") && message.contains("F4 opens"), qPrintable(message));
    open.perform(open.nextEvent());
    QVERIFY(open.message().isEmpty());
    // The next session begins without the noise that somebody had wanted.
    open.window().startSession(ParticipantId("P02"));
    QCOMPARE(open.message(), message);
    sound.stop();
}

void AppParticipantTest::helperProgramsGetNoSecretOfTheOwner()
{
    const QString program = QDir(QCoreApplication::applicationDirPath()).relativeFilePath("/usr/bin/env");
    study::app::LineProcess process(nullptr);
    QStringList variables;
    bool hasEnded = false;
    connect(&process, &study::app::LineProcess::lineRead, this,
            [&](const std::string& line) { variables << QString::fromStdString(line); });
    connect(&process, &study::app::LineProcess::ended, this, [&] { hasEnded = true; });
    qputenv("VIS2HAP_PASSPHRASE", "Sekret1");
    qputenv("PGPASSWORD", "Sekret2");
    qputenv("OF_THE_LAB", "kept");
    process.start(program, {}, study::app::ProgramSurroundings::Own);
    for (const char* variable : {"VIS2HAP_PASSPHRASE", "PGPASSWORD", "OF_THE_LAB"}) qunsetenv(variable);
    QTRY_VERIFY(hasEnded);
    QVERIFY(variables.contains("OF_THE_LAB=kept"));
    QVERIFY2(variables.filter("Sekret").isEmpty() && variables.filter("PGPASSWORD").isEmpty(), "a secret was passed on");
}

QTEST_MAIN(AppParticipantTest)
#include "app_participant_test.moc"
