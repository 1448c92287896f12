// vis2hap power, as a person who plans a study runs it.
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

using nlohmann::json;

namespace {

json powerOf(const QStringList& arguments)
{
    const auto ended = support::mustRun(QStringList{"power", "--studies", "40", "--json"} + arguments);
    return json::parse(ended.out.toStdString());
}

json testNamed(const json& answer, const std::string& name)
{
    for (const auto& test : answer["tests"])
        if (test["test"] == name) return test;
    return {};
}

}  // namespace

class PowerCommandTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_small = m_folder.filePath("small.json");
        QFile out(m_small);
        QVERIFY(out.open(QIODevice::WriteOnly));
        out.write(
            "{\"schema\":\"vis2hap.protocol/1\",\"name\":\"Small\",\"participants\":12,\"fabrics\":4,"
            "\"conditions\":[\"v_grey\",\"f\",\"h\"],\"phases\":[{\"questions\":[\"Q2\"],"
            "\"scale\":{\"min\":0,\"max\":10,\"step\":0.5,\"sections\":9}}]}");
    }

    void thePapersStudyDetectsThreeQuartersOfAPoint()
    {
        const auto answer = powerOf({});
        QCOMPARE(answer["schema"].get<std::string>(), std::string("vis2hap.power/1"));
        QCOMPARE(answer["design"]["participants"].get<int>(), 10);
        QCOMPARE(answer["design"]["alternatives"].get<int>(), 3);
        // R: power.t.test(n = 10, power = .8, sd = sqrt(2*(.15 + .85/7)), type = "paired", strict = TRUE)
        const auto t = testNamed(answer, "paired t of participants' means");
        QVERIFY(std::abs(t["detected_with_80_percent"].get<double>() - 0.733842) < 1e-5);
        QCOMPARE(t["points"].size(), std::size_t(3));
        QCOMPARE(t["points"][0]["participants_for_80_percent"].get<int>(), 20);
        // This test has no formula, so the answer has a reason instead of a number.
        const auto q = testNamed(answer, "Cochran's Q");
        QVERIFY(q["points"][0]["power"].is_null() && q["points"][0]["why"]["power"].is_string());
        QVERIFY(q["points"][2]["power_simulated"].get<double>() > q["points"][0]["power_simulated"].get<double>());
        QVERIFY(!answer.contains("calibration"));
    }

    void theSameSeedGivesTheSameAnswer()
    {
        const auto answer = [this](const QString& seed) { return powerOf({"--protocol", m_small, "--seed", seed}); };
        QVERIFY(answer("3") == answer("3"));
        QVERIFY(answer("3") != answer("4"));
    }

    void aProtocolOfItsOwnIsPlanned()
    {
        const auto answer = powerOf({"--protocol", m_small, "--calibrate", "100"});
        QCOMPARE(answer["design"]["conditions"].get<int>(), 3);
        for (const auto& test : answer["tests"]) QVERIFY(test["question"] != "choices");
        QVERIFY(answer["calibration"].size() > 100);  // tests, and claims under twenty nulls
        const auto more = powerOf({"--protocol", m_small, "--participants", "40"});
        const auto detected = [](const json& from) {
            return testNamed(from, "Friedman")["detected_with_80_percent"].get<double>();
        };
        QVERIFY(detected(more) < detected(answer));
    }

    /// A test takes the mean of the answers under the instructions, which has less noise.
    void ratingsUnderInstructionsAreAveraged()
    {
        const auto residual = [this](const QByteArray& instructions) {
            QFile small(m_small), instructed(m_folder.filePath("instructed.json"));
            if (!small.open(QIODevice::ReadOnly) || !instructed.open(QIODevice::WriteOnly)) return -1.0;
            instructed.write(small.readAll().replace("\"sections\":9}", "\"sections\":9}" + instructions));
            instructed.close();
            return powerOf({"--protocol", instructed.fileName()})["assumed"]["variance_residual"].get<double>();
        };
        QVERIFY(support::mustRun({"power", "--studies", "40", "--protocol",
                                  QString(VIS2HAP_SOURCE_DIR) + "/protocols/examples/speed_accuracy.json"})
                    .out.contains("One choice in a cell is counted. The protocol asks for 3"));
        const double once = residual("");
        const double twice =
            residual(R"(, "instructions": [{"id": "fast", "aim": "speed"}, {"id": "exact", "aim": "accuracy"}])");
        QVERIFY(once > 0);
        QCOMPARE(twice, once / 2);
    }

    void aCountContinuesWhereItWasInterrupted()
    {
        const QString file = m_folder.filePath("counts.json");
        const QStringList call{"--protocol", m_small, "--planted", "100", "--calibrate", "100", "--resume", file};
        const auto answer = powerOf(call);
        QCOMPARE(answer["planted"].size(), std::size_t(10 * (5 + 7 + 5 + 3)));
        // An interruption leaves a file with some truths only; those that are there are not counted again.
        QFile stored(file);
        QVERIFY(stored.open(QIODevice::ReadOnly));
        auto counts = json::parse(stored.readAll().toStdString());
        stored.close();
        auto& finished = counts["planted"]["finished"];
        QCOMPARE(finished.size(), std::size_t(40));
        finished.erase(finished.begin());
        counts["calibrate"]["finished"].erase(counts["calibrate"]["finished"].begin());
        QVERIFY(stored.open(QIODevice::WriteOnly));
        stored.write(counts.dump().c_str());
        stored.close();
        QVERIFY(powerOf(call) == answer);
        const auto store = [&stored](const json& altered) {
            QVERIFY(stored.open(QIODevice::WriteOnly));
            stored.write(altered.dump().c_str());
            stored.close();
        };
        // A name from the file gives the terminal no orders.
        json named = counts;
        named["planted"]["finished"].front()[0]["name"] = "a\x1b[2J";
        store(named);
        const QString text = support::mustRun(QStringList{"power", "--studies", "20"} + call).out;
        QVERIFY(!text.contains(QChar(0x1b)) && text.contains("a\\x1b[2J"));
        // Three studies do not stand for a hundred.
        json few = counts;
        for (auto& truth : few["calibrate"]["finished"]) truth[0] = json::array({3, 3, 0});
        store(few);
        const auto refused = support::runProgram(QStringList{"power", "--studies", "20"} + call);
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("the counts are those of 3 studies") && refused.err.contains("counts of 100 studies"),
                 qPrintable(refused.err));
        // Sums of such counts would begin at 0 again.
        json forged = counts;
        for (auto& truth : forged["calibrate"]["finished"]) truth[0] = json::array({std::uint64_t{1} << 63, 0, 0});
        store(forged);
        const auto huge = support::runProgram(QStringList{"power", "--studies", "20"} + call);
        QVERIFY2(huge.exitCode == 2 && huge.err.contains("the counts are damaged"), qPrintable(huge.err));
        // Other settings would be mixed with these; a damaged file would be believed.
        QCOMPARE(support::runProgram(QStringList{"power", "--studies", "20", "--seed", "7"} + call).exitCode, 2);
        QVERIFY(stored.open(QIODevice::WriteOnly));
        stored.write("[]");
        stored.close();
        QCOMPARE(support::runProgram(QStringList{"power", "--studies", "20"} + call).exitCode, 2);
        QCOMPARE(support::runProgram({"power", "--studies", "20", "--resume", file}).exitCode, 2);
    }

    /// The text names the question and the scale that its numbers are for, and how to get another.
    void theTextSaysWhatIsAssumed()
    {
        const QString file = m_folder.filePath("two.json");
        QFile out(file);
        QVERIFY(out.open(QIODevice::WriteOnly));
        out.write(R"({"schema":"vis2hap.protocol/1","name":"Two","participants":12,"fabrics":4,"conditions":["v_grey","f","h"],
            "question_texts":{"W1":"How rough?"},"phases":[{"questions":["Q2"],"scale":{"min":0,"max":100,"step":1,"sections":9}},
            {"questions":["W1"],"scale":{"min":1,"max":4,"step":1,"labels":["no","hardly","rather","very"]}}]})");
        out.close();
        const auto ended = support::mustRun({"power", "--studies", "40", "--protocol", file, "--question", "W1"});
        QVERIFY(ended.out.contains("Two: 12 participants x 4 fabrics x 3 conditions"));
        QVERIFY(ended.out.contains("The results depend on these assumptions"));
        QVERIFY(
            ended.out.contains("The ratings are those of W1, from 1 to 4 in steps of 1. Another scale: Q2; see it by "
                               "--question Q2."));
        // R: power.t.test(n = 12, power = .8, sd = 0.3*sqrt(2*(.15 + .85/4)), type = "paired", strict = TRUE)
        QVERIFY2(ended.out.contains("paired t of participants' means; 80 % power at 0.23"), qPrintable(ended.out));
        const auto unknown = support::runProgram({"power", "--protocol", file, "--question", "Q9"});
        QVERIFY2(unknown.exitCode == 2 && unknown.err.contains("one of Q2, W1"), qPrintable(unknown.err));
    }

    /// R: with n = 72 and p = 1/2, 44 right answers are the fewest above chance, which a share of 0.6512 reaches in 80 % of
    /// studies: uniroot(function(p) pbinom(43, 72, p, FALSE) - .8, c(.5, .9), tol = 1e-9)$root - .5
    void sameOrDifferentIsAChoiceBetweenTwo()
    {
        const auto answer = powerOf({"--protocol", QString(VIS2HAP_SOURCE_DIR) + "/protocols/examples/same_different.json"});
        QCOMPARE(answer["design"]["alternatives"], 2);
        QCOMPARE(answer["chosen"]["question"], "Same");
        QCOMPARE(answer["chosen"]["kind"], "same_different");
        QVERIFY(!answer.contains("rated"));
        QCOMPARE(answer["left_out"], json::array());
        const auto binomial = testNamed(answer, "exact binomial against chance");
        QCOMPARE(binomial["question"], "choices");
        QVERIFY2(std::abs(binomial["detected_with_80_percent"].get<double>() - 0.151236) < 1e-4, binomial.dump().c_str());
        QVERIFY(!testNamed(answer, "logistic mixed model, likelihood ratio").is_null());
    }

    /// One number of alternatives and one scale at a time; the rest is named, with the option that shows it.
    void questionsWithoutNumbersAreNamed()
    {
        const QString file = m_folder.filePath("kinds.json");
        QFile out(file);
        QVERIFY(out.open(QIODevice::WriteOnly));
        out.write(R"({"schema":"vis2hap.protocol/1","name":"Kinds","participants":12,"fabrics":4,"conditions":["v_grey","f","h"],
            "question_texts":{"S1":"The same?","W1":"What is it like?"},"phases":[{"questions":["Q1"],"alternatives":3},
            {"questions":["S1","W1"],"same_different":true,"free_text":["W1"]},
            {"questions":["Q2"],"scale":{"min":0,"max":10}}]})");
        out.close();
        const auto first = powerOf({"--protocol", file}), second = powerOf({"--protocol", file, "--question", "S1"});
        QCOMPARE(first["design"]["alternatives"], 3);
        QCOMPARE(first["chosen"]["questions_with_other_alternatives"], json::array({"S1"}));
        QCOMPARE(first["left_out"],
                 json::parse(R"([{"question":"S1","why":"another number of alternatives; see it by --question"},
                                 {"question":"W1","why":"answers in words have no test"}])"));
        QCOMPARE(second["design"]["alternatives"], 2);
        QCOMPARE(second["chosen"]["questions_with_other_alternatives"], json::array({"Q1"}));
        QCOMPARE(second["rated"], first["rated"]);
        const QString text = support::mustRun({"power", "--studies", "40", "--protocol", file}).out;
        QVERIFY2(text.contains("The choices are those of Q1, among 3 answers. Another number of alternatives: S1; see it by "
                               "--question S1.\nLeft out, because answers in words have no test: W1.\n"),
                 qPrintable(text));
        const auto words = support::runProgram({"power", "--protocol", file, "--question", "W1"});
        QVERIFY2(words.exitCode == 2 && words.err.contains("one of Q1, S1, Q2"), qPrintable(words.err));
    }

    void wrongCallsEndWithTwo()
    {
        QCOMPARE(support::runProgram({"power", "--protocol", "/there/is/none.json"}).exitCode, 2);
        QCOMPARE(support::runProgram({"power", "--participants", "1"}).exitCode, 2);
        QCOMPARE(support::runProgram({"power", "--studies", "many"}).exitCode, 2);
    }

private:
    QTemporaryDir m_folder;
    QString m_small;
};

QTEST_GUILESS_MAIN(PowerCommandTest)
#include "power_command_test.moc"
