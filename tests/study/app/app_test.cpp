// Sessions through the real window: complete ones by keyboard and by mouse, typed ratings, and a session that continues
// after the window was closed. The tests compare the stored answers with the typed ones.
#include <QElapsedTimer>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>
#include <algorithm>

#include "study/app/pieces/scale_line.h"
#include "tests/support/played_session.h"
#include "tests/support/typed_answers.h"

using namespace study::session;
using namespace tests::support;
using protocols::FabricId;
using protocols::Tenths;

namespace {

bool isPresenting(OpenWindow& open) { return std::holds_alternative<Presenting>(open.view().state.stage); }

bool isFinished(OpenWindow& open) { return std::holds_alternative<Finished>(open.view().state.stage); }

void clickOn(OpenWindow& open, const char* objectName) { QTest::mouseClick(&open.widget<QWidget>(objectName), Qt::LeftButton); }

/// Gives one answer by mouse only; ratings by a click on the line.
void answerByMouse(OpenWindow& open, const GivenAnswer& response)
{
    clickOn(open, "touchButton");
    if (const auto* fabric = std::get_if<FabricId>(&response)) {
        const auto& tray = open.view().trayIds;
        const auto place = std::find(tray.begin(), tray.end(), *fabric) - tray.begin();
        clickOn(open, ("answer" + std::string(1, static_cast<char>('A' + place))).c_str());
    } else {
        auto& line = open.widget<study::app::ScaleLine>("scaleLine");
        QTest::mouseClick(&line, Qt::LeftButton, Qt::NoModifier, line.pointOf(std::get<Tenths>(response)));
    }
    clickOn(open, "storeButton");
}

}  // namespace

class AppTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void wholeSessionByKeyboardAlone();
    void wholeSessionByMouseAlone();
    void windowStoresTheSameRowsAsTheEngine();
    void paperSizedSessionTakesSeconds();
    void pageRefusesTextThatIsNotARating_data();
    void pageRefusesTextThatIsNotARating();
    void commaAndPointAreTheSameNumber();
    void reopenedSessionContinuesAtTheSamePresentation();
};

void AppTest::wholeSessionByKeyboardAlone()
{
    const auto folder = newStudy();
    Answers typed;
    {
        OpenWindow open(folder);
        QCOMPARE(open.widget<QLineEdit>("participantField").text(), QString("P01"));
        pressKey(open, Qt::Key_Return);  // enrols
        QVERIFY(open.window().session());
        while (!isFinished(open)) {
            if (std::holds_alternative<ScaleTraining>(open.view().state.stage)) {
                pressKey(open, Qt::Key_G);  // the participant knows the scale
                continue;
            }
            if (!isPresenting(open)) {
                pressKey(open, Qt::Key_Return);
                continue;
            }
            const GivenAnswer spoken = responseTo(open.view());
            typed[nowAsked(open)] = answerText(spoken);
            answerByKeys(open, spoken, u'.');
        }
        QCOMPARE(answersIn(folder), typed);
        pressKey(open, Qt::Key_Return);
        QTRY_VERIFY(!open.window().session());
    }
    QCOMPARE(typed.size(), std::size_t(6 + 3 * 6));
    for (const auto& stored : storedIn(folder)) {
        QVERIFY(stored.record.touchedAtNs.has_value());
        QCOMPARE(stored.seconds, 2.0);  // from touch to answer, by the injected clock
        QCOMPARE(stored.corrections, 0);
    }
}

void AppTest::wholeSessionByMouseAlone()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    Answers clicked;
    clickOn(open, "enrolButton");
    while (!isFinished(open)) {
        if (std::holds_alternative<PlacingTray>(open.view().state.stage)) {
            clickOn(open, "trayReadyButton");
        } else if (std::holds_alternative<ScaleTraining>(open.view().state.stage)) {
            clickOn(open, "scaleKnownButton");
        } else if (!isPresenting(open)) {
            clickOn(open, "confirmButton");
        } else {
            const GivenAnswer spoken = responseTo(open.view());
            clicked[nowAsked(open)] = answerText(spoken);
            answerByMouse(open, spoken);
        }
    }
    QCOMPARE(answersIn(folder), clicked);
    clickOn(open, "confirmButton");
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
}

void AppTest::windowStoresTheSameRowsAsTheEngine()
{
    const auto byWindow = newStudy(), byEngine = newStudy();
    {
        OpenWindow open(byWindow);
        open.enrolAndBegin();
        open.playTo("Presenting", "Q3");
        open.perform(Corrected{protocols::QuestionId("Q2"), Tenths{31}, "misheard"});
        open.perform(Paused{});
        open.perform(Resumed{});
        open.playToEnd();
    }
    {
        OpenWindow open(byEngine);  // used only for its fakes; this run sends events to the engine directly
        database::SessionStore& store = open.window().study()->store();
        const auto display = rendering::openDisplay("none");
        Driver driver(store, protocols::ParticipantId("P01"), database::ParticipantKind::Human, open.window().study()->images(),
                      *display, open.clock());
        bool isCorrected = false;
        while (!std::holds_alternative<Finished>(driver.state().stage)) {
            const View view = driver.view();
            EventBody event = nextEvent(view, driver.plan()).value();
            if (!isCorrected && std::holds_alternative<Presenting>(view.state.stage) && view.question->id.value == "Q3") {
                event = Corrected{protocols::QuestionId("Q2"), Tenths{31}, "misheard"};
                isCorrected = true;
            }
            QVERIFY(!driver.send(event));
        }
    }
    QVERIFY(!answersIn(byWindow).empty());
    QCOMPARE(answersIn(byWindow), answersIn(byEngine));
}

void AppTest::paperSizedSessionTakesSeconds()
{
    const auto folder = newStudy({.fabrics = 7,
                                  .conditions = {"v_grey", "v_shape", "f_g", "h_g", "h_g&f_g", "t_grey", "f", "h", "h&f"},
                                  .breakAfter = 21});
    OpenWindow open(folder);
    open.enrolAndBegin();
    QElapsedTimer timer;
    timer.start();
    open.playToEnd();
    QCOMPARE(answersIn(folder).size(), std::size_t(63 + 3 * 63));
    QVERIFY2(timer.elapsed() < 20000, qPrintable(QString::number(timer.elapsed()) + " ms"));
    qInfo("252 answers through the window in %lld ms", static_cast<long long>(timer.elapsed()));
}

void AppTest::pageRefusesTextThatIsNotARating_data()
{
    QTest::addColumn<QString>("typed");
    QTest::addColumn<QString>("expectedText");
    QTest::newRow("above the scale") << "11"
                                     << "outside the scale";
    QTest::newRow("just above") << "10.1"
                                << "outside the scale";
    QTest::newRow("below the scale") << "-1"
                                     << "outside the scale";
    QTest::newRow("two decimals") << "5.45"
                                  << "at most one decimal";
    QTest::newRow("two points") << "5.4.3"
                                << "at most one decimal";
    QTest::newRow("unfinished") << "5."
                                << "at most one decimal";
    QTest::newRow("nothing") << ""
                             << "Type the number";
}

void AppTest::pageRefusesTextThatIsNotARating()
{
    QFETCH(QString, typed);
    QFETCH(QString, expectedText);
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    const auto before = answersIn(folder);
    typeText(open, typed);
    pressKey(open, Qt::Key_Return);
    QVERIFY2(open.message().contains(expectedText), qPrintable(open.message()));
    QCOMPARE(answersIn(folder), before);
    QCOMPARE(open.view().question->id.value, std::string("Q2"));

    open.widget<QLineEdit>("ratingField").clear();
    typeText(open, "4.2");
    pressKey(open, Qt::Key_Return);
    QCOMPARE(answersIn(folder).size(), before.size() + 1);
    QVERIFY(open.message().isEmpty());
    QCOMPARE(open.view().question->id.value, std::string("Q3"));
}

void AppTest::commaAndPointAreTheSameNumber()
{
    const auto folder = newStudy();
    OpenWindow open(folder);
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    const std::string asked = nowAsked(open);
    answerByKeys(open, Tenths{54}, u',');
    QCOMPARE(answersIn(folder).at(asked), std::string("5.4"));
}

void AppTest::reopenedSessionContinuesAtTheSamePresentation()
{
    const auto folder = newStudy();
    std::string code;
    Answers before;
    {
        OpenWindow open(folder);
        open.enrolAndBegin();
        open.playTo("Presenting", "Q3");
        code = open.view().code.value;
        before = answersIn(folder);
        QVERIFY(open.window().close());
        QCOMPARE(open.display().calls.back(), std::string("clear"));
    }
    OpenWindow open(folder);
    QVERIFY(open.widget<QPushButton>("resumeButton").text().contains("P01"));
    QCOMPARE(open.window().focusWidget()->objectName(), QString("resumeField"));
    pressKey(open, Qt::Key_Return);
    QVERIFY(!open.window().session());
    QVERIFY2(open.message("studyMessage").contains("Type P01"), qPrintable(open.message("studyMessage")));
    open.gui().type("P01");
    pressKey(open, Qt::Key_Return);
    QVERIFY(open.view().state.paused);
    QVERIFY(open.widget<QLabel>("pageTitle").text().contains("Welcome back"));
    pressKey(open, Qt::Key_G);  // skips the preparation
    QCOMPARE(open.view().code.value, code);
    QCOMPARE(nameOf(open.view().state), std::string("PlacingTray"));
    QVERIFY(open.widget<QLabel>("presentationCode").text().endsWith(QString::fromStdString(code)));
    QCOMPARE(answersIn(folder), before);
    open.playToEnd();
    QCOMPARE(answersIn(folder).size(), std::size_t(24));
}

QTEST_MAIN(AppTest)
#include "app_test.moc"
