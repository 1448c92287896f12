// `vis2hap protocol check` and `protocol show`: what somebody sees who writes a protocol for the first time.
#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "tests/support/program.h"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// Ten faults, each on a line of its own.
constexpr const char* tenFaults = R"({
  "$schema": "../protocol.schema.json",
  "schema": "vis2hap.protocol/1",
  "name": "",
  "participants": 0,
  "fabrics": 1000,
  "conditions": ["v_grey", "h_g", "Größe"],
  "phases": [
    {"questions": ["Q1"], "alternatives": 1},
    {"questions": ["2nd"], "scale": {"min": 0, "max": 10}},
    {"questions": ["Q3"]}
  ],
  "question_texts": {"2nd": "How?", "Q3": "And?"},
  "planned": [["h_g", "h"]],
  "seconds_per_presentation": "long",
  "sitting_minute": 60
}
)";

}  // namespace

class ProtocolCommandTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void tenFaultsAreToldAtOnceEachWithItsLineAndColumn()
    {
        const QString file = written("ten.json", tenFaults);
        const auto result = support::runProgram({"protocol", "check", file});
        QCOMPARE(result.exitCode, 2);
        const QStringList lines = result.out.trimmed().split('\n');
        const std::pair<int, const char*> expected[] = {{4, "name"},
                                                        {5, "participants: 0"},
                                                        {6, "fabrics: 1000"},
                                                        {7, "Größe"},
                                                        {9, "alternatives: 1"},
                                                        {10, "2nd"},
                                                        {11, "phases[2]"},
                                                        {14, "'h'"},
                                                        {15, "seconds_per_presentation: \"long\""},
                                                        {16, "sitting_minute"}};
        QVERIFY2(lines.size() == 11, qPrintable(result.out));
        for (int i = 0; i < 10; ++i) {
            const QString place = QString("%1:%2:").arg(file).arg(expected[i].first);
            QVERIFY2(lines[i].startsWith(place) && lines[i].contains(QString::fromUtf8(expected[i].second)),
                     qPrintable(lines[i]));
        }
        QVERIFY2(lines[10].contains("10 faults"), qPrintable(lines[10]));
        // The column of the 'ö' counts characters, not bytes.
        QVERIFY2(lines[3].startsWith(file + ":7:35:"), qPrintable(lines[3]));
    }

    void jsonHasTheSameFaults()
    {
        const auto result = support::runProgram({"protocol", "check", written("ten.json", tenFaults), "--json"});
        QCOMPARE(result.exitCode, 2);
        const Json json = Json::parse(result.out.toStdString());
        QCOMPARE(json["schema"], "vis2hap.protocol_check/1");
        QCOMPARE(json["sound"], false);
        QCOMPARE(json["faults"].size(), std::size_t(10));
        QCOMPARE(json["faults"][1]["line"], 5);
        QCOMPARE(json["faults"][1]["column"], 19);
    }

    /// `study new` printed these lines, but not `check`, where the file can still be changed.
    void whatASoundFileLeavesInDoubtIsSaid()
    {
        const char* oneEnd = R"({"schema":"vis2hap.protocol/1","name":"Own end","participants":10,"fabrics":7,
            "conditions":["v_grey","h&f"],"participant_texts":{"scale_low":"smooth as glass"},
            "phases":[{"questions":["Q2"],"scale":{"min":0,"max":10}}]})";
        const QString file = written("one\x1b[31mend.json", oneEnd);
        const auto said = support::mustRun({"protocol", "check", file});
        QVERIFY2(said.out.contains("note: participant_texts: the study has its own scale_low, but no "), qPrintable(said.out));
        QVERIFY2(said.out.contains("note: equivalence within ") && said.out.contains("no fault"), qPrintable(said.out));
        QVERIFY(!said.out.contains('\x1b'));
        const auto json = support::mustRun({"protocol", "check", file, "--json"});
        QCOMPARE(Json::parse(json.out.toStdString())["notes"].size(), std::size_t(2));
        const auto faulty = support::runProgram({"protocol", "check", written("two\x1b[31mfaults.json", tenFaults)});
        QVERIFY(faulty.exitCode == 2 && !faulty.out.contains('\x1b'));
    }

    /// Q1 gets the paper's sentence, also where the phase asks something else; own questions get the paper's ends.
    void usualTextsThatMayNotFitAreNamed()
    {
        const auto said = support::mustRun(
            {"protocol", "check",
             written(
                 "numbered.json",
                 R"({"schema":"vis2hap.protocol/1","name":"Numbered","participants":10,"fabrics":7,"conditions":["v_grey","h&f"],
            "question_texts":{"R":"How rough does the screen feel?"},
            "phases":[{"questions":["Q1"],"same_different":true},{"questions":["R"],"scale":{"min":0,"max":10}}]})")});
        QVERIFY2(said.out.contains("note: question_texts: the usual sentence of Q1 asks for another kind of answer"),
                 qPrintable(said.out));
        QVERIFY2(said.out.contains("note: participant_texts: the ends of the scale of R are \"unrelated\" and"),
                 qPrintable(said.out));
        const auto paper = support::mustRun({"protocol", "check", QString(VIS2HAP_SOURCE_DIR "/protocols/vis2hap.json")});
        QVERIFY2(!paper.out.contains("_texts"), qPrintable(paper.out));
    }

    void everyExampleIsSoundAndShown()
    {
        int examples = 0;
        for (const auto& entry : fs::directory_iterator(fs::path(VIS2HAP_SOURCE_DIR) / "protocols" / "examples")) {
            if (entry.path().extension() != ".json") continue;
            const QString file = QString::fromStdString(entry.path().string());
            const auto checked = support::mustRun({"protocol", "check", file});
            QVERIFY2(checked.out.contains("no fault"), qPrintable(checked.out));
            const auto shown = support::mustRun({"protocol", "show", file});
            const auto protocol = protocols::readProtocol(entry.path());
            for (const QString& words : {QString("%1 presentation").arg(protocol.presentations()),
                                         QString("%1 answer").arg(protocol.answersPerParticipant()),
                                         QString("balance of the running orders"), QString("can detect")})
                QVERIFY2(shown.out.contains(words), qPrintable(words + " in " + shown.out));
            ++examples;
        }
        QCOMPARE(examples, 9);
    }

    /// The numbers of the paper's study: 63 renderings twice, 252 answers, three in a hundred Q1 by Wilson at most.
    void thePaperStudyIsShown()
    {
        const QString file = QString(VIS2HAP_SOURCE_DIR) + "/protocols/vis2hap.json";
        const Json plan = Json::parse(support::mustRun({"protocol", "show", file, "--json"}).out.toStdString());
        QCOMPARE(plan["presentations_per_participant"], 126);
        QCOMPARE(plan["answers_per_participant"], 252);
        QCOMPARE(plan["answers"], 2520);
        QCOMPARE(plan["minutes_per_participant"].get<double>(), 52.5);
        QCOMPARE(plan["phases"].size(), std::size_t(2));
        QCOMPARE(plan["phases"][0]["pieces_on_tray"], 3);
        // 70 answers to a condition: 31 right (p = .044) are the fewest above chance; `power` has the same t test.
        for (const Json& row : plan["detects"]) QVERIFY(row["smallest"].is_number());
        QVERIFY(std::abs(plan["detects"][1]["smallest"].get<double>() - 0.73) < 0.01);
        for (const Json& range : plan["balance"]) QVERIFY(range["max"] >= range["min"]);
    }

    /// 25 choices in blocks of 20 and 5, then 25 ratings in blocks of 20 and 5: three breaks. A phase begins with a new block.
    void breaksAreThoseOfTheSession()
    {
        const QString file = written("phases.json", R"({"schema":"vis2hap.protocol/1","name":"Two phases","participants":2,
            "fabrics":5,"conditions":["v_grey","t_grey","f","h","h&f"],"break_after":20,
            "phases":[{"questions":["Q1"],"alternatives":3},{"questions":["Q2"],"scale":{"min":0,"max":10}}]})");
        QVERIFY(support::mustRun({"protocol", "show", file}).out.contains("; 3 breaks, "));
        QCOMPARE(Json::parse(support::mustRun({"protocol", "show", file, "--json"}).out.toStdString())["breaks"], 3);
    }

    void aPilotOfOneIsShownWithWhatItCannotTell()
    {
        const QString file = QString(VIS2HAP_SOURCE_DIR) + "/protocols/examples/pilot.json";
        const auto shown = support::mustRun({"protocol", "show", file});
        QVERIFY2(shown.out.contains("1 participant,") && shown.out.contains("needs at least 2 participants"),
                 qPrintable(shown.out));
    }

    /// The differences are those of each scale, and no larger than the scale.
    void eachScaleHasItsOwnSmallestDifference()
    {
        const auto shownFor = [&](int participants) {
            const QByteArray text =
                R"({"schema":"vis2hap.protocol/1","name":"Two scales","participants":)" + QByteArray::number(participants) +
                R"(,"fabrics":7,"conditions":["v_grey","f","h"],"question_texts":{"W1":"How rough?"},"phases":[
                {"questions":["Q2"],"scale":{"min":0,"max":100,"step":1,"sections":9}},
                {"questions":["W1"],"scale":{"min":1,"max":4,"step":1,"labels":["no","hardly","rather","very"]}}]})";
            return Json::parse(
                support::mustRun({"protocol", "show", written("scales.json", text), "--json"}).out.toStdString())["detects"];
        };
        const auto smallest = [](const Json& rows, int row) { return rows[row]["smallest"].get<double>(); };
        const Json twelve = shownFor(12), three = shownFor(3);
        // R: power.t.test(n = 12, power = .8, sd = 10*sqrt(2*(.15 + .85/7)), type = "paired", strict = TRUE)
        QVERIFY2(std::abs(smallest(twelve, 0) - 6.550) < 0.005, twelve.dump().c_str());
        QVERIFY(std::abs(smallest(twelve, 1) - 0.03 * smallest(twelve, 0)) < 1e-6);
        QVERIFY2(smallest(three, 1) < 1.5, three.dump().c_str());
    }

    /// Python, with n = 12 * 7 answers under a condition, and three times as many: the fewest above chance by the binomial test,
    /// and the share that reaches them in 80 % of studies. Means over three instructions have a third of the residual.
    void instructionsGiveMoreAnswers()
    {
        const auto shownFor = [&](const QByteArray& instructions) {
            const QByteArray text = R"({"schema":"vis2hap.protocol/1","name":"Fast","participants":12,"fabrics":7,
                "conditions":["v_grey","f","h"],"phases":[{"questions":["Q1"],"alternatives":3)" +
                                    instructions + R"(},{"questions":["Q2"],"scale":{"min":0,"max":10})" + instructions + "}]}";
            return Json::parse(
                support::mustRun({"protocol", "show", written("fast.json", text), "--json"}).out.toStdString())["detects"];
        };
        const Json once = shownFor(""), thrice = shownFor(R"(,"instructions":[{"id":"a"},{"id":"b"},{"id":"c"}])");
        const auto smallest = [](const Json& rows, int row) { return rows[row]["smallest"].get<double>(); };
        QVERIFY2(std::abs(smallest(once, 0) - 0.468493) < 1e-4, once.dump().c_str());
        QVERIFY2(std::abs(smallest(thrice, 0) - 0.409040) < 1e-4, thrice.dump().c_str());
        const double ratio = std::sqrt((0.15 + 0.85 / 21) / (0.15 + 0.85 / 7));
        QVERIFY2(std::abs(smallest(thrice, 1) / smallest(once, 1) - ratio) < 1e-4, thrice.dump().c_str());
    }

    void filesThatAreNoProtocolHaveOneClearLine_data()
    {
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("words");
        QTest::newRow("missing") << m_folder.filePath("none.json") << "none.json";
        QTest::newRow("a folder") << m_folder.path() << m_folder.path();
        QTest::newRow("no JSON") << written("text.json", "name: study\n") << "line 1, column";
        QTest::newRow("a comma too many") << written("comma.json", "{\n  \"name\": \"x\",\n}\n") << "line 3, column 1";
        QTest::newRow("UTF-16") << written("utf16.json", QByteArray("\xFF\xFE{\0}\0", 6)) << "UTF-8";
        QTest::newRow("a list") << written("list.json", "[]") << "1 fault";
    }

    void filesThatAreNoProtocolHaveOneClearLine()
    {
        QFETCH(QString, file);
        QFETCH(QString, words);
        const auto result = support::runProgram({"protocol", "check", file});
        QCOMPARE(result.exitCode, 2);
        QVERIFY2((result.out + result.err).contains(words), qPrintable(result.out + result.err));
    }

    void aProtocolCannotCommandTheTerminal()
    {
        const char* text = "{\"\\u001b]0;owned\\u0007\\u001b[2J\": 1}";
        const auto result = support::runProgram({"protocol", "check", written("escape.json", text)});
        QCOMPARE(result.exitCode, 2);
        QVERIFY2(result.out.contains("\\x1b]0;owned") && !result.out.contains('\x1b'), qPrintable(result.out));
    }

    void tenThousandLinesAreCheckedInSeconds()
    {
        QElapsedTimer timer;
        timer.start();
        const auto all = support::runProgram({"protocol", "check", written("long.json", protocolWithTexts(10000))});
        QCOMPARE(all.exitCode, 2);
        QVERIFY2(all.out.contains("question_texts: 10001 keys, expected at most 2000"), qPrintable(all.out));
        const auto allowed = support::runProgram({"protocol", "check", written("allowed.json", protocolWithTexts(1999))});
        QCOMPARE(allowed.exitCode, 2);
        QVERIFY2(allowed.out.contains("'X1000'") && allowed.out.contains("1899 more faults"), qPrintable(allowed.out));
        QVERIFY2(timer.elapsed() < 10000, qPrintable(QString::number(timer.elapsed())));
    }

private:
    /// With a sentence for each of `unknown` questions that it does not ask.
    static QByteArray protocolWithTexts(int unknown)
    {
        QByteArray text =
            "{\n  \"schema\": \"vis2hap.protocol/1\",\n  \"name\": \"long\",\n  \"participants\": 1,\n  \"fabrics\": 2,\n"
            "  \"conditions\": [\"h\", \"f\"],\n  \"phases\": [{\"questions\": [\"Q1\"], \"alternatives\": 2}],\n"
            "  \"question_texts\": {\n";
        for (int i = 0; i < unknown; ++i) text += "    \"X" + QByteArray::number(i) + "\": \"?\",\n";
        return text + "    \"Q1\": \"Which?\"\n  }\n}\n";
    }

    QString written(const QString& name, const QByteArray& text)
    {
        QFile file(m_folder.filePath(name));
        file.open(QIODevice::WriteOnly);
        file.write(text);
        return file.fileName();
    }

    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(ProtocolCommandTest)
#include "protocol_command_test.moc"
