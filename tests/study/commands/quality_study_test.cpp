// A study that compares renderings of several prices, through the program: protocol, study, simulated participants, replay,
// report.
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSet>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

using support::mustRun;
using support::runProgram;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* protocolText =
    R"({"schema": "vis2hap.protocol/1", "name": "prices", "participants": 2, "fabrics": 3,
    "conditions": ["v_shape@fast", "h_g", "h_g+f_g@fast", "h_g@balanced", "h_g@fast", "h"],
    "planned": [["h_g@fast", "h_g"], ["h_g@fast", "h"]],
    "phases": [{"questions": ["Q1"], "alternatives": 3}, {"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})";

Json jsonIn(const QString& file)
{
    std::ifstream in(file.toStdString());
    return Json::parse(in);
}

QString textIn(const QString& file)
{
    QFile in(file);
    return in.open(QIODevice::ReadOnly) ? QString::fromUtf8(in.readAll()) : QString();
}

}  // namespace

class QualityStudyTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase()
    {
        std::ofstream(path("prices.json").toStdString()) << protocolText;
        mustRun({"fabrics", "make", path("fabrics"), "--fabrics", "4", "--samples", "4", "--seed", "5"});
        const auto made = newStudy("study");
        QVERIFY2(made.err.contains("conditions h_g and h_g@balanced give the same image for"), qPrintable(made.err));
        for (const QString& line : made.err.split('\n').filter("give the same image"))
            QVERIFY2(!line.contains("@accurate"), "only the study's own conditions are named");
        mustRun({"simulate", path("study")});
    }

    void blindedReportAndFilesTellNothingOfTheQualities()
    {
        mustRun({"report", path("study"), "--out", path("blinded")});
        const Json results = jsonIn(path("blinded/results.json"));
        QCOMPARE(results["conditions"].dump(), std::string(R"(["K1","K2","K3","K4","K5","K6"])"));
        QVERIFY(results["chain"].is_null());
        for (const QString& file : {path("blinded/index.html"), path("blinded/results.json"), path("blinded/statistics.json")})
            for (const char* word : {"@fast", "@balanced", "h_g"})
                QVERIFY2(!textIn(file).contains(word), qPrintable(file + word));
        QVERIFY(!QDir(path("blinded/tables")).exists("chain.csv"));
        // Every stimulus has the size and the time of every other.
        QSet<qint64> sizes;
        QSet<QDateTime> times;
        for (const QFileInfo& file : QDir(path("study/stimuli")).entryInfoList(QDir::Files)) {
            sizes.insert(file.size());
            times.insert(file.lastModified());
        }
        QCOMPARE(sizes.size(), 1);
        QCOMPARE(times.size(), 1);
    }

    void unblindedReportShowsTheWholeChain()
    {
        unblind("study");
        mustRun({"report", path("study"), "--out", path("report")});
        const Json results = jsonIn(path("report/results.json"));
        std::map<std::string, Json> rows;
        std::string order;
        for (const Json& row : results["chain"]) {
            rows[row["condition"]] = row;
            order += row["condition"].get<std::string>() + " ";
        }
        QCOMPARE(order, std::string("v_shape@fast h_g h_g@fast h_g@balanced h_g&f_g@fast h "));
        const auto number = [&](const char* condition, const char* field) {
            return rows.at(condition)["rendering"][field].get<double>();
        };
        QVERIFY(number("h_g@fast", "relief_error_percent") > 0.1);
        QVERIFY(number("h_g@fast", "felt_difference_jnd") > 0);
        QVERIFY(number("h_g&f_g@fast", "friction_error_percent") > 0);
        QVERIFY(number("h_g@fast", "milliseconds") > 0);
        QVERIFY(number("v_shape@fast", "felt_from_measured_jnd") > 0);
        QCOMPARE(number("h_g", "relief_error_percent"), number("h_g@balanced", "relief_error_percent"));
        QCOMPARE(rows.at("h_g")["rendering"]["quality"], rows.at("h_g@balanced")["rendering"]["quality"]);
        QCOMPARE(rows.at("h")["rendering"]["why"]["height_spectrum_db"].get<std::string>(),
                 std::string("its signals are measured"));
        QCOMPARE(rows.at("h_g@fast")["questions"]["Q1"]["proportion"], results["questions"]["Q1"]["h_g@fast"]["proportion"]);
        QCOMPARE(results["claims"][0]["a"].get<std::string>(), std::string("h_g@fast"));
        QVERIFY(textIn(path("report/tables/chain.csv")).contains("\nh_g@fast,fast,"));
        QVERIFY(QFile::exists(path("report/figures/chain.svg")));
        const QString page = textIn(path("report/index.html"));
        const int begin = page.indexOf("<section id=\"chain\""), end = page.indexOf("</section>", begin);
        QVERIFY(begin > 0 && page.mid(begin, end - begin).contains("SIMULATED participants"));
    }

    void exportedSessionsReplayUnderTheirQualities()
    {
        newStudy("again");
        mustRun({"export", path("study"), "--out", path("scripts"), "--format", "script"});
        QStringList replay{"replay", path("again")};
        for (const QFileInfo& file : QDir(path("scripts")).entryInfoList({"*.json"}, QDir::Files, QDir::Name))
            replay << file.filePath();
        QVERIFY(textIn(replay.back()).contains("h_g@fast"));
        mustRun(replay);
        unblind("again");
        for (const char* study : {"study", "again"})
            mustRun({"export", path(study), "--out", path(QString(study) + "-csv"), "--format", "csv"});
        const auto answers = [&](const char* study) {
            mustRun({"report", path(study), "--out", path(QString(study) + "-report"), "--quick"});
            return jsonIn(path(QString(study) + "-report/results.json"))["questions"].dump();
        };
        QCOMPARE(answers("again"), answers("study"));
        QVERIFY(textIn(path("study-csv/answers.csv")).contains("h_g@fast"));
    }

    void renderTakesQualitiesToo()
    {
        mustRun({"render", path("fabrics"), "--fabric", "F01", "--condition", "v_shape@fast,v_shape", "--out", path("images")});
        QVERIFY(QFile::exists(path("images/F01/v_shape@fast.png")));
        QCOMPARE(jsonIn(path("images/render.json"))["conditions"]["v_shape@fast"]["quality"].get<std::string>(),
                 std::string("fast"));
        const auto refused = runProgram({"render", path("fabrics"), "--condition", "f@fast", "--out", path("none")});
        QCOMPARE(refused.exitCode, 2);
        QCOMPARE(refused.messages().size(), 1);
        QVERIFY2(refused.err.contains("'f@fast' has a quality, which changes nothing of f"), qPrintable(refused.err));
        QVERIFY(!QFile::exists(path("none")));
    }

private:
    QString path(const QString& name) const { return m_folder.filePath(name); }

    support::ProgramResult newStudy(const QString& name) const
    {
        return mustRun({"study", "new", path(name), "--dataset", path("fabrics"), "--protocol", path("prices.json"), "--seed",
                        "3", "--key-seed", "4", "--no-passphrase", "--images", path("kept-images")});
    }

    void unblind(const QString& name) const { mustRun({"unblind", path(name), "--who", "test", "--why", "the study is over"}); }

    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(QualityStudyTest)
#include "quality_study_test.moc"
