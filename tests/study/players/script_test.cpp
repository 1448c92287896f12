// The file of a scripted participant: its contents, and the faults that are found before anything is stored.
#include "study/players/script.h"

#include <QTest>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"
#include "study/players/player_answers.h"

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

    /// Exported scripts hold ids, and another lab may call a fabric by a word of scripts.
    void aFabricMayBeCalledLikeAWordOfScripts()
    {
        using protocols::FabricId;
        const std::vector<FabricId> tray{FabricId("foil:2"), FabricId("silk"), FabricId("correct")};
        const auto chosen = [&](const std::vector<FabricId>& pieces, const char* answer) {
            return std::get<FabricId>(
                scriptedAnswer(std::string(answer), protocols::ForcedChoice{}, {pieces, pieces[1], "trial 1"}));
        };
        QCOMPARE(chosen(tray, "correct"), FabricId("correct"));
        QCOMPARE(chosen(tray, "foil:2"), FabricId("foil:2"));
        QCOMPARE(chosen(tray, "foil:1"), FabricId("foil:2"));
        QCOMPARE(chosen({FabricId("wool"), FabricId("silk"), FabricId("felt")}, "correct"), FabricId("silk"));
    }

    /// A repetition without an answer of its own gets that of the first presentation; a mismatch does not.
    void answersCanNameAnAnchor()
    {
        using protocols::AnchorKind;
        const auto script = parse(R"([{"question":"Q2","condition":"h&f","fabric":"F03","answer":8},
                                      {"question":"Q2","condition":"h&f","fabric":"F03","answer":2,"anchor":"mismatched"},
                                      {"question":"Q2","condition":"f","fabric":"F03","answer":6},
                                      {"question":"Q2","condition":"f","fabric":"F03","answer":5,"anchor":"repeated"}])");
        const auto ratingOf = [&](const char* condition, AnchorKind anchor) {
            const auto* found =
                script.answerTo(protocols::QuestionId("Q2"),
                                {std::nullopt, protocols::ConditionId(condition), protocols::FabricId("F03"), 1, {}, anchor});
            return found ? std::get<protocols::Tenths>(found->response).value : -1;
        };
        QCOMPARE(ratingOf("h&f", AnchorKind::None), 80);
        QCOMPARE(ratingOf("h&f", AnchorKind::Mismatched), 20);
        QCOMPARE(ratingOf("h&f", AnchorKind::Repeated), 80);
        QCOMPARE(ratingOf("f", AnchorKind::Repeated), 50);
        QCOMPARE(ratingOf("f", AnchorKind::Mismatched), -1);
        const auto refuse = [] { parse(R"([{"question":"Q2","condition":"f","fabric":"F03","answer":6,"anchor":"floor"}])"); };
        try {
            refuse();
            QFAIL("an unknown anchor is taken");
        } catch (const protocols::Error& error) {
            const QString what = QString::fromStdString(error.what());
            QVERIFY2(what.contains("unknown anchor \"floor\"") && what.contains("mismatched"), qPrintable(what));
        }
    }

    /// An answer without an instruction holds under every instruction that has none of its own.
    void answersCanNameAnInstruction()
    {
        auto protocol = paper();
        protocol.phases[0].instructions = {
            {protocols::InstructionId("speed"), protocols::SpeedAim::Speed, {}, "Be fast."},
            {protocols::InstructionId("accuracy"), protocols::SpeedAim::Accuracy, {}, "Be right."}};
        const auto parseInstructed = [&](const std::string& name) {
            return scriptFromJson(R"({"schema":"vis2hap.script/1","participant":"S01","answers":[
                {"question":"Q1","condition":"f","fabric":"F03","answer":"correct"},
                {"question":"Q1","condition":"f","fabric":"F03","instruction":")" +
                                      name + R"(","answer":"foil:1"}]})",
                                  "s.json", protocol);
        };
        const auto script = parseInstructed("speed");
        const auto answerUnder = [&](const char* instruction) {
            const ScriptedPlace place{std::nullopt, protocols::ConditionId("f"), protocols::FabricId("F03"), 1,
                                      protocols::InstructionId(instruction)};
            return std::get<std::string>(script.answerTo(protocols::QuestionId("Q1"), place)->response);
        };
        QCOMPARE(answerUnder("speed"), std::string("foil:1"));
        QCOMPARE(answerUnder("accuracy"), std::string("correct"));
        QVERIFY_EXCEPTION_THROWN(parseInstructed("luck"), protocols::Error);
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
        QTest::newRow("unknown condition") << R"([{"question":"Q2","condition":"w w","fabric":"F03","answer":5}])"
                                           << "[]"
                                           << "h_g&f_g";
        QTest::newRow("misspelt condition of one's own") << R"([{"question":"Q2","condition":"mien","fabric":"F03","answer":5}])"
                                                         << "[]"
                                                         << "unknown condition 'mien'; expected a condition of the study: v_grey";
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
        const auto answer = [](const char* field) {
            return QString(R"([{"question":"Q2","trial":1,"answer":5,%1}])").arg(field);
        };
        const auto event = [](const char* field) { return QString(R"([{"after_answer":1,"do":"note",%1}])").arg(field); };
        QTest::newRow("no object") << "[7]"
                                   << "[]"
                                   << "answer 1: it is no object";
        QTest::newRow("null") << "[null]"
                              << "[]"
                              << "answer 1: it is no object";
        QTest::newRow("question of a number") << R"([{"question":7,"trial":1,"answer":5}])"
                                              << "[]"
                                              << "line 1";
        QTest::newRow("answer of a list") << R"([{"question":"Q2","trial":1,"answer":[5]}])"
                                          << "[]"
                                          << "answer 1";
        QTest::newRow("huge rating") << R"([{"question":"Q2","trial":1,"answer":1e300}])"
                                     << "[]"
                                     << "tenths";
        QTest::newRow("huge trial") << R"([{"question":"Q2","trial":4294967297,"answer":5}])"
                                    << "[]"
                                    << "trial is not a whole number";
        QTest::newRow("trial 0") << R"([{"question":"Q2","trial":0,"answer":5}])"
                                 << "[]"
                                 << "trial is not a whole number from 1";
        QTest::newRow("attempt of words") << answer("\"attempt\":\"one\"") << "[]"
                                          << "attempt is not a whole number";
        QTest::newRow("time of a list") << answer("\"seconds\":[1]") << "[]"
                                        << "seconds is out of range";
        QTest::newRow("unknown finger") << answer("\"touched_by\":\"nobody\"") << "[]"
                                        << "touched_by";
        QTest::newRow("events of a number") << "[]"
                                            << "7"
                                            << "the events are no list";
        QTest::newRow("event of words") << "[]"
                                        << R"(["pause"])"
                                        << "event 1: it is no object";
        QTest::newRow("note of a number") << "[]" << event("\"text\":7") << "event 1: text is no text";
        QTest::newRow("flag of a word") << "[]" << event("\"flag\":\"yes\"") << "flag is neither true nor false";
        QTest::newRow("huge count") << "[]"
                                    << R"([{"after_answer":99999999999999999999,"do":"pause"}])"
                                    << "after_answer is not a whole number";
        QTest::newRow("refusal of null") << "[]" << event("\"refusal\":null") << "refusal is no text";
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

    void wholeFilesThatAreNoScriptsAreRefused_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("named");
        const auto script = [](QByteArray text) { return text.replace('\'', '"'); };
        QTest::newRow("schema of a number") << script("{'schema':1,'participant':'S01','answers':[]}") << "not a script";
        QTest::newRow("schema of null") << script("{'schema':null,'participant':'S01','answers':[]}") << "not a script";
        QTest::newRow("a list") << QByteArray("[]") << "it is no object";
        QTest::newRow("Latin-1") << script("{'schema':'vis2hap.script/1','participant':'Bj\xF6rn','answers':[]}")
                                 << "line 1, column 47: the text is not UTF-8";
        QTest::newRow("zero byte") << QByteArray("{\0}", 3) << "line 1, column 2: the text holds a zero byte";
        QTest::newRow("participant of a list") << script("{'schema':'vis2hap.script/1','participant':['S01'],'answers':[]}")
                                               << "the text \"participant\" is missing";
        QTest::newRow("participant of a path") << script("{'schema':'vis2hap.script/1','participant':'../victim','answers':[]}")
                                               << "\"../victim\" cannot name a participant: it begins with a dot";
        QTest::newRow("no answers") << script("{'schema':'vis2hap.script/1','participant':'S01'}") << "list of answers";
    }
    void wholeFilesThatAreNoScriptsAreRefused()
    {
        QFETCH(QByteArray, text);
        QFETCH(QString, named);
        try {
            scriptFromJson(text.toStdString(), "s.json", paper());
            QFAIL("the faulty script was accepted");
        } catch (const protocols::Error& error) {
            QCOMPARE(error.exitCode(), protocols::ExitCode::BadInput);
            QVERIFY2(QString(error.what()).startsWith("s.json, line 1, column "), error.what());
            QVERIFY2(QString(error.what()).contains(named), error.what());
        }
    }
};

QTEST_GUILESS_MAIN(ScriptTest)
#include "script_test.moc"
