// The file of a scripted participant: its contents, and the faults that are found before anything is stored.
#include "study/players/script.h"

#include <QtTest>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"

using namespace study::players;

namespace {

protocols::Protocol paper() { return protocols::protocolFromJson(protocols::paperProtocolJson(), "paper"); }

Script parse(const std::string& answers, const std::string& events = "[]")
{
    return scriptFromJson(
        R"({"schema":"vis2hap.script/1","participant":"S01","answers":)" + answers + R"(,"events":)" + events + "}", "s.json",
        paper());
}

}  // namespace

class ScriptTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void answersAreLookedUpByQuestionConditionAndFabric()
    {
        const auto script = parse(R"([{"question":"Q1","condition":"h_g+f_g","fabric":"F03","answer":"foil:2","seconds":8.25},
                                      {"question":"Q2","condition":"v_grey","fabric":"F03","answer":5.4,"seconds":3}])");
        const auto* match = script.answerTo(protocols::QuestionId("Q1"),
                                            {std::nullopt, protocols::ConditionId("h_g&f_g"), protocols::FabricId("F03")});
        QVERIFY(match);
        QCOMPARE(std::get<std::string>(match->response), std::string("foil:2"));
        QCOMPARE(match->seconds, 8.25);
        const auto* rating = script.answerTo(protocols::QuestionId("Q2"),
                                             {std::nullopt, protocols::ConditionId("v_grey"), protocols::FabricId("F03")});
        QVERIFY(rating);
        QCOMPARE(std::get<protocols::Tenths>(rating->response).value, 54);
        QVERIFY(!script.answerTo(protocols::QuestionId("Q2"),
                                 {std::nullopt, protocols::ConditionId("f"), protocols::FabricId("F03")}));
    }

    void eventsCountAnswersStored()
    {
        const auto script = parse("[]", R"([{"before_answer":40,"do":"pause"},
            {"after_answer":52,"do":"correct","question":"Q3","answer":4.0,"why":"misheard"},{"after_answer":100,"do":"crash"}])");
        QCOMPARE(script.events[0].answersStoredBefore, 39);
        QVERIFY(script.events[0].beforeAnswer);
        QCOMPARE(script.events[1].answersStoredBefore, 52);
        QCOMPARE(script.events[1].text, std::string("misheard"));
        QCOMPARE(script.events[2].what, ScriptedEvent::What::Crash);
    }

    void whatIsWrongIsNamed_data()
    {
        QTest::addColumn<QString>("answers");
        QTest::addColumn<QString>("events");
        QTest::addColumn<QString>("named");
        const QString good = R"({"question":"Q2","condition":"v_grey","fabric":"F03","answer":5.5,"seconds":3.1})";
        QTest::newRow("doubled") << "[" + good + "," + good + "]"
                                 << "[]"
                                 << "two answers to Q2 for v_grey, F03";
        QTest::newRow("unknown condition") << R"([{"question":"Q2","condition":"w","fabric":"F03","answer":5}])"
                                           << "[]"
                                           << "h_g&f_g";
        QTest::newRow("unknown question") << R"([{"question":"Q9","condition":"f","fabric":"F03","answer":5}])"
                                          << "[]"
                                          << "Q9";
        QTest::newRow("hundredths") << R"([{"question":"Q2","condition":"f","fabric":"F03","answer":5.55}])"
                                    << "[]"
                                    << "tenths";
        QTest::newRow("no answer") << R"([{"question":"Q2","condition":"f","fabric":"F03"}])"
                                   << "[]"
                                   << "answer 1";
        QTest::newRow("negative time") << R"([{"question":"Q2","condition":"f","fabric":"F03","answer":5,"seconds":-1}])"
                                       << "[]"
                                       << "seconds";
        QTest::newRow("unknown event") << "[]"
                                       << R"([{"after_answer":1,"do":"dance"}])"
                                       << "dance";
        QTest::newRow("event without place") << "[]"
                                             << R"([{"do":"pause"}])"
                                             << "before_answer";
    }

    void whatIsWrongIsNamed()
    {
        QFETCH(QString, answers);
        QFETCH(QString, events);
        QFETCH(QString, named);
        try {
            parse(answers.toStdString(), events.toStdString());
            QFAIL("the faulty script was accepted");
        } catch (const protocols::Error& error) {
            QCOMPARE(error.exitCode(), protocols::ExitCode::BadInput);
            QVERIFY2(QString(error.what()).contains(named), error.what());
            QVERIFY2(QString(error.what()).contains("s.json"), error.what());
        }
    }
};

QTEST_GUILESS_MAIN(ScriptTest)
#include "script_test.moc"
