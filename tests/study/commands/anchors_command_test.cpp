// Anchors from the protocol to the report: a simulated study with mismatched and repeated presentations, through the commands.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "protocols/files/csv_table.h"
#include "tests/support/program.h"

using support::mustRun;
using support::runProgram;
using Json = nlohmann::ordered_json;

namespace {

constexpr int participants = 8, mismatched = 4, repeated = 6, repeatedChoices = 5, renderings = 20;

constexpr const char* protocolText =
    R"({"schema": "vis2hap.protocol/1", "name": "anchored", "participants": 8, "fabrics": 5,
    "conditions": ["v_grey", "f", "h", "h&f"], "break_after": 6, "planned": [["h&f", "v_grey"]],
    "phases": [{"questions": ["Q1"], "alternatives": 3, "anchors": {"repeated": 5}},
               {"questions": ["Q2", "Q3"], "scale": {"min": 0, "max": 10}, "anchors": {"mismatched": 4, "repeated": 6}}]})";

Json jsonIn(const QString& file)
{
    std::ifstream in(file.toStdString());
    return Json::parse(in);
}

QByteArray textIn(const QString& file)
{
    QFile in(file);
    return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
}

protocols::CsvTable tableIn(const QString& file)
{
    return protocols::csvTableFrom(textIn(file).toStdString(), file.toStdString());
}

}  // namespace

class AnchorsCommandTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        std::ofstream(path("anchored.json").toStdString()) << protocolText;
        mustRun({"fabrics", "make", path("fabrics"), "--fabrics", "6", "--samples", "4", "--seed", "5"});
        mustRun({"study", "new", path("study"), "--dataset", path("fabrics"), "--protocol", path("anchored.json"), "--seed", "3",
                 "--no-passphrase", "--allow-training-samples"});
        mustRun({"simulate", path("study"), "--seed", "7"});
    }

    void theStatusCountsThemAndTheBalanceDoesNot()
    {
        const Json status = Json::parse(mustRun({"study", "status", path("study"), "--json"}).out.toStdString());
        const int answers = renderings + repeatedChoices + 2 * (renderings + mismatched + repeated);
        QCOMPARE(status["answers_per_participant"].get<int>(), answers);
        for (const Json& slot : status["slots"]) QCOMPARE(slot["answers"].get<int>(), answers);
        // Each rendering once, also of what was presented; the running order has the anchors in it.
        for (const Json& range : status["balance"])
            if (range["what"].get<std::string>().starts_with("presentations of a rendering per participant"))
                QVERIFY(range["min"] == 1 && range["max"] == 1);
        // Before the unblinding, two of these counts name the trial between them.
        QVERIFY(status["balance_presented"].is_null() && status["why"].contains("balance_presented"));
        const auto plan = mustRun({"study", "plan", path("study"), "--csv", path("plan.csv")});
        const auto rows = tableIn(path("plan.csv"));
        QCOMPARE(static_cast<int>(rows.rows.size()), participants * (2 * renderings + repeatedChoices + mismatched + repeated));
        QVERIFY(!textIn(path("plan.csv")).contains("mismatched"));
    }

    void theBlindedReportShowsNoAnchor()
    {
        mustRun({"report", path("study"), "--out", path("blinded")});
        const Json results = jsonIn(path("blinded/results.json"));
        QVERIFY(results["anchors"].is_null());
        const QByteArray page = textIn(path("blinded/index.html"));
        QVERIFY(!page.contains("</b> floor: "));
        QVERIFY(!page.contains("h&amp;f"));
        // Every K-label has the same number of answers: a surplus would name the condition of the mismatched images.
        for (const auto& [label, numbers] : results["questions"]["Q2"].items())
            QCOMPARE(numbers["n"].get<int>(), participants * renderings / 4);
        mustRun({"export", path("study"), "--out", path("blinded-export")});
        for (const QFileInfo& file : QDir(path("blinded-export")).entryInfoList(QDir::Files)) {
            const QByteArray text = textIn(file.filePath());
            QVERIFY2(!text.contains("mismatched") && !text.contains("repeated,"), qPrintable(file.fileName()));
        }
    }

    void nobodyLearnsWhichPresentationIsAnAnchor()
    {
        const auto leaks = runProgram({"leak-check", path("study")});
        QVERIFY2(leaks.out.contains("learned anchor"), qPrintable(leaks.out + leaks.err));
        for (const QString& line : leaks.out.split('\n').filter("***"))
            QVERIFY2(!line.contains(" anchor ") && !line.contains(" condition "), qPrintable(line));
    }

    /// The plan lists every rule by which the report flags.
    void thePlanHasTheRuleOfMismatches()
    {
        mustRun({"study", "preregister", path("study")});
        QVERIFY(textIn(path("study/preregistration.txt")).contains("\n- mismatch_rated_high: the mean rating of mismatched"));
        const Json exclusions = jsonIn(path("study/preregistration.json"))["plan"]["exclusions"];
        QVERIFY(exclusions["rules"].dump().find("mismatch_rated_high") != std::string::npos);
        QVERIFY(exclusions["second_analysis_without"].dump().find("mismatch_rated_high") == std::string::npos);
    }

    void theReportHasFloorReliabilityAndCeiling()
    {
        mustRun({"unblind", path("study"), "--who", "tester", "--why", "test"});
        const Json status = Json::parse(mustRun({"study", "status", path("study"), "--json"}).out.toStdString());
        QVERIFY(!status["balance_presented"].empty());
        for (const Json& range : status["balance_presented"])
            if (range["what"].get<std::string>().starts_with("presentations of a rendering per participant"))
                QVERIFY(range["min"] == 1 && range["max"] == 1);
        mustRun({"report", path("study"), "--out", path("report")});
        const Json anchors = jsonIn(path("report/results.json"))["anchors"];
        QCOMPARE(anchors.size(), std::size_t(3));
        QCOMPARE(anchors[0]["repeated"]["pairs"].get<int>(), participants * repeatedChoices);
        QVERIFY(anchors[0]["repeated"]["ceiling_of_proportion"].get<double>() > 1.0 / 3);
        for (const std::size_t question : {1, 2}) {
            const Json& floor = anchors[question]["mismatched"];
            QCOMPARE(floor["condition"].get<std::string>(), std::string("h&f"));
            QCOMPARE(anchors[question]["repeated"]["pairs"].get<int>(), participants * repeated);
            const double ceiling = anchors[question]["repeated"]["ceiling_of_mean"].get<double>();
            QVERIFY(ceiling > 8 && ceiling < 10);
        }
        // The model of touch feels that the fabric is another one.
        const Json questions = jsonIn(path("report/results.json"))["questions"];
        QVERIFY(anchors[1]["mismatched"]["mean"].get<double>() < questions["Q2"]["h&f"]["mean"].get<double>());
        QCOMPARE(questions["Q2"]["h&f"]["n"].get<int>(), participants * 5);
        for (const char* file : {"tables/anchors.csv", "tables/anchors_retest.csv"})
            QVERIFY(QFile::exists(path("report/") + file));
        QVERIFY(textIn(path("report/tables/q2_ratings.csv")).contains("floor: another fabric"));
        const QByteArray figure = textIn(path("report/figures/ratings.svg"));
        for (const char* line : {">floor Q2<", ">ceiling Q3<"}) QVERIFY2(figure.contains(line), line);
    }

    void theExportMarksThemAndGivesTheSameReport()
    {
        mustRun({"export", path("study"), "--out", path("export")});
        const auto table = tableIn(path("export/answers.csv"));
        const auto anchor = table.column("anchor");
        QVERIFY(anchor);
        std::map<std::string, int> counts;
        for (const auto& row : table.rows) ++counts[row[*anchor]];
        QCOMPARE(counts["mismatched"], participants * 2 * mismatched);
        QCOMPARE(counts["repeated"], participants * (2 * repeated + repeatedChoices));
        QCOMPARE(counts[""], participants * 3 * renderings);
        QVERIFY(textIn(path("export/codebook.csv")).contains("answers.csv,anchor,text,,mismatched; repeated,"));
        mustRun({"report", "--from", path("export/answers.csv"), "--out", path("again"), "--protocol", path("anchored.json")});
        const Json own = jsonIn(path("report/results.json")), again = jsonIn(path("again/results.json"));
        QCOMPARE(again["anchors"].dump(), own["anchors"].dump());
        QCOMPARE(again["questions"].dump(), own["questions"].dump());
        QVERIFY(own["study"]["simulated"] == true && again["study"]["simulated"] == true);
        QVERIFY(textIn(path("again/index.html")).contains("SIMULATED participants"));
        const auto kind = table.column("kind");
        QVERIFY(kind && std::ranges::all_of(table.rows, [&](const auto& row) { return row[*kind] == "simulated"; }));
        QVERIFY(textIn(path("export/codebook.csv")).contains("answers.csv,kind,text,,human; scripted; simulated,"));
    }

    /// The trays of one phase hold all five fabrics, so that a choice can be the same again; the other phase has other foils.
    void eachQuestionIsComparedByItsTrays()
    {
        std::ofstream(path("mixed.json").toStdString())
            << R"({"schema": "vis2hap.protocol/1", "name": "mixed", "participants": 4, "fabrics": 5,
            "conditions": ["v_grey", "f", "h", "h&f"], "break_after": 6, "planned": [["h&f", "v_grey"]],
            "question_texts": {"Five": "Which of the five pieces feels like the screen?"},
            "phases": [{"questions": ["Q1"], "alternatives": 3, "anchors": {"repeated": 5}, "catch_trials": 2},
                       {"questions": ["Five"], "alternatives": 5, "anchors": {"repeated": 5}}]})";
        mustRun({"study", "new", path("mixed"), "--dataset", path("fabrics"), "--protocol", path("mixed.json"), "--seed", "3",
                 "--no-passphrase", "--allow-training-samples"});
        mustRun({"simulate", path("mixed"), "--seed", "7"});
        mustRun({"unblind", path("mixed"), "--who", "tester", "--why", "test"});
        mustRun({"report", path("mixed"), "--out", path("mixed-report")});
        const Json own = jsonIn(path("mixed-report/results.json"));
        QCOMPARE(own["anchors"][0]["repeated"]["compared"].get<std::string>(), std::string("right and wrong"));
        QCOMPARE(own["anchors"][1]["repeated"]["compared"].get<std::string>(), std::string("answers"));
        // The published answers lack the times of day, and give the same report.
        mustRun({"export", path("mixed"), "--out", path("published"), "--public"});
        mustRun(
            {"report", "--from", path("published/answers.csv"), "--out", path("mixed-again"), "--protocol", path("mixed.json")});
        const Json again = jsonIn(path("mixed-again/results.json"));
        QCOMPARE(again["anchors"].dump(), own["anchors"].dump());
        QCOMPARE(again["questions"].dump(), own["questions"].dump());
    }

    void recordedScriptsPlayThemAgain()
    {
        mustRun({"export", path("study"), "--out", path("scripts"), "--format", "script"});
        mustRun({"study", "new", path("replayed"), "--dataset", path("fabrics"), "--protocol", path("anchored.json"), "--seed",
                 "3", "--no-passphrase", "--allow-training-samples"});
        QStringList call{"replay", path("replayed")};
        for (const QFileInfo& file : QDir(path("scripts")).entryInfoList({"*.json"}, QDir::Files)) call << file.filePath();
        const auto replayed = runProgram(call);
        // Another secret has other mismatches and trays, to which the script may have no answer: the replay then says where.
        QVERIFY2(replayed.exitCode == 0 || replayed.err.contains("no answer") || replayed.err.contains("is not on the tray"),
                 qPrintable(replayed.err));
        QVERIFY(textIn(call.last()).contains("\"anchor\": \"mismatched\""));
    }

    void aSimulationInMemoryLeavesThemOut()
    {
        mustRun({"simulate", path("study"), "--in-memory", "--participants", "40", "--seed", "2", "--out", path("memory")});
        const Json questions = jsonIn(path("memory/results.json"))["questions"];
        QVERIFY(questions["Q2"]["h&f"]["mean"].get<double>() > questions["Q2"]["v_grey"]["mean"].get<double>());
        QCOMPARE(questions["Q2"]["h&f"]["n"].get<int>(), 40 * 5);
    }

private:
    QString path(const QString& name) const { return m_folder.filePath(name); }

    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(AnchorsCommandTest)
#include "anchors_command_test.moc"
