// The examples of protocols, each from its file to a report, as their pages tell a reader to do.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>

#include "rendering/images/image_io.h"
#include "tests/support/program.h"

using support::mustRun;
using support::runProgram;
using Json = nlohmann::ordered_json;

namespace {

Json jsonIn(const QString& file)
{
    std::ifstream in(file.toStdString());
    return Json::parse(in);
}

const Json& claimOf(const Json& results, const std::string& question, const std::string& a, const std::string& b)
{
    for (const Json& claim : results["claims"])
        if (claim["question"] == question && claim["a"] == a && claim["b"] == b && claim["generalises_to"] == "these_fabrics")
            return claim;
    throw std::runtime_error("no claim " + question + " " + a + " " + b);
}

}  // namespace

class ExamplesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// The examples in a folder of their own, with what their pages put beside them.
    void initTestCase()
    {
        mustRun({"fabrics", "make", path("cloth"), "--fabrics", "7", "--samples", "12", "--seed", "3"});
        for (const QString& folder : {QString(), QString("teaching")}) {
            const QDir from(QString(VIS2HAP_SOURCE_DIR) + "/protocols/examples/" + folder);
            QDir().mkpath(path("examples/" + folder));
            for (const QString& file : from.entryList(QDir::Files)) QFile::copy(from.filePath(file), at(folder + "/" + file));
        }
        // The page: images of `render`, changed by any tool.
        mustRun({"render", path("cloth"), "--fabric", "all", "--condition", "h", "--out", path("start")});
        QDir().mkpath(at("our-images"));
        for (int k = 1; k <= 5; ++k) {
            const QString fabric = QString("F0%1").arg(k);
            const cv::Mat image = 255 - rendering::readPng(path("start/" + fabric + "/h.png").toStdString());
            rendering::writePng(at("our-images/" + fabric + ".png").toStdString(), image);
        }
        m_before = QDir::currentPath();
        QDir::setCurrent(path("examples"));
    }

    void cleanupTestCase() { QDir::setCurrent(m_before); }

    void everyExampleBecomesAReport_data()
    {
        QTest::addColumn<QString>("file");
        for (const QString& file : QDir(at("")).entryList({"*.json"}))
            if (file != "teaching.json") QTest::newRow(qPrintable(file)) << file;
    }

    void everyExampleBecomesAReport()
    {
        QFETCH(QString, file);
        QStringList options;
        if (file == "own_program.json") options = QStringList{"--program", "ours=python3 own_program.py"};
        const QString study = path(file.section('.', 0, 0));
        const auto made = newStudy(study, file, options);
        QVERIFY2(made.exitCode == 0, qPrintable(made.err));
        mustRun({"simulate", study});
        mustRun({"unblind", study, "--who", "tester", "--why", "test"});
        mustRun({"report", study, "--quick", "--out", study + "-report"});
        const Json results = jsonIn(study + "-report/results.json");
        QVERIFY(results["study"]["simulated"] == true);
        const Json protocol = jsonIn(at(file));
        QCOMPARE(results["conditions"].size(), protocol["conditions"].size());
        for (std::size_t i = 0; i < results["conditions"].size(); ++i) {
            const Json& condition = protocol["conditions"][i];
            QCOMPARE(results["conditions"][i], condition.is_object() ? condition["id"] : condition);
        }
    }

    /// A class finds what teaching/README.md says was planted, and nothing else.
    void plantedEffectsAreFoundAndTheCarelessParticipantIsFlagged()
    {
        const QString study = path("class");
        QVERIFY(newStudy(study, "teaching.json", {}).exitCode == 0);
        const auto played = mustRun({"simulate", study, "--plant", "teaching/effects.json"});
        QVERIFY2(played.out.contains("8 simulated participants answered with the planted effects of teaching/effects.json"),
                 qPrintable(played.out));
        mustRun({"verify", study});
        mustRun({"report", study, "--out", path("blinded")});
        QVERIFY(!QDir(path("blinded")).isEmpty());
        mustRun({"unblind", study, "--who", "tester", "--why", "test"});
        mustRun({"report", study, "--out", path("open")});
        const Json results = jsonIn(path("open/results.json"));
        QVERIFY(results["study"]["simulated"] == true);

        std::set<std::string> flagged, flags;
        for (const Json& flag : results["quality"]) {
            if (flag["participant"].is_string()) flagged.insert(flag["participant"].get<std::string>());
            flags.insert(flag["flag"].get<std::string>());
        }
        QVERIFY2(flagged == std::set<std::string>{"SIM05"}, qPrintable(QString::fromStdString(results["quality"].dump())));
        for (const char* flag : {"too_fast", "straight_lining", "slot_bias"}) QVERIFY2(flags.contains(flag), flag);

        const Json& planted = claimOf(results, "Q2", "h&f", "v_grey");
        QCOMPARE(planted["verdict"].get<std::string>(), std::string("different"));
        QVERIFY2(planted["primary"] == true, planted.dump().c_str());
        // 3.5 points for seven participants and none for the eighth.
        QVERIFY2(std::abs(planted["estimate"].get<double>() - 3.5 * 7 / 8) < 0.8, planted.dump().c_str());
        QCOMPARE(claimOf(results, "Q2", "h&f", "h_g&f_g")["verdict"].get<std::string>(), std::string("different"));
        const Json& nothing = claimOf(results, "Q2", "h_g&f_g", "h_g");
        QVERIFY2(nothing["verdict"] != "different" && nothing["ci95"][0] < 0 && nothing["ci95"][1] > 0, nothing.dump().c_str());
        for (const auto& [a, b] : {std::pair{"h&f", "v_grey"}, {"h_g&f_g", "h_g"}, {"h&f", "h_g&f_g"}})
            QVERIFY(claimOf(results, "Q3", a, b)["verdict"] != "different");
        const Json& choices = results["questions"]["Q1"];
        QVERIFY(choices["h&f"]["p_chance"].get<double>() < 0.001);
        QVERIFY(choices["h&f"]["proportion"].get<double>() > choices["h_g"]["proportion"].get<double>());
    }

    void plantsThatDoNotFitAreRefusedBeforeTheFirstAnswer_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("words");
        QTest::newRow("another participant") << QByteArray(R"({"schema": "vis2hap.plant/1", "careless": ["SIM09"]})")
                                             << "the careless participant SIM09 takes no part; expected SIM01 to SIM08";
        QTest::newRow("another study") << QByteArray(R"({"schema": "vis2hap.plant/1", "ratings": {"Q4": {"mean": 5}}})")
                                       << "the study has no question 'Q4'; expected one of Q1, Q2, Q3";
        QTest::newRow("no JSON") << QByteArray("careless: SIM01") << "line 1";
    }

    void plantsThatDoNotFitAreRefusedBeforeTheFirstAnswer()
    {
        QFETCH(QByteArray, text);
        QFETCH(QString, words);
        const QString study = path("untouched");
        if (!QDir(study).exists()) QVERIFY(newStudy(study, "teaching.json", {}).exitCode == 0);
        std::ofstream(path("plant.json").toStdString()) << text.toStdString();
        const auto refused = runProgram({"simulate", study, "--plant", path("plant.json")});
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.messages().size() == 1 && refused.err.contains(words), qPrintable(refused.err));
        const Json status = Json::parse(mustRun({"study", "status", study, "--json"}).out.toStdString());
        QVERIFY2(!QString::fromStdString(status.dump()).contains("SIM0"), status.dump(1).c_str());
        const auto memory =
            runProgram({"simulate", study, "--in-memory", "--out", path("memory"), "--plant", path("plant.json")});
        QVERIFY2(memory.exitCode == 2 && memory.err.contains("--plant was given together with --in-memory"),
                 qPrintable(memory.err));
    }

private:
    QString path(const QString& name) const { return m_folder.filePath(name); }
    QString at(const QString& name) const { return path("examples/" + name); }

    support::ProgramResult newStudy(const QString& study, const QString& protocol, const QStringList& options) const
    {
        return runProgram(QStringList{"study", "new", study, "--dataset", path("cloth"), "--protocol", protocol, "--seed", "1",
                                      "--key-seed", "1", "--no-passphrase"} +
                          options);
    }

    QTemporaryDir m_folder;
    QString m_before;
};

QTEST_GUILESS_MAIN(ExamplesTest)
#include "examples_test.moc"
