// The files of a report: their names, their form and their contents.
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/strict_json.h"
#include "reports/json/results_json.h"
#include "reports/json/signals_json.h"
#include "reports/page/report_document.h"
#include "reports/write_report.h"
#include "tests/reports/study_builder.h"

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

std::string textOf(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

QString page(const fs::path& folder) { return QString::fromStdString(textOf(folder / "index.html")); }

reports::StudyData richStudy()
{
    reports::StudyData data = builders::paperSized();
    data.name = "A <study> & more";
    data.simulated = true;
    data.stamps = {"The weights were trained on other fabrics."};
    data.planned = {{"h_g&f_g", "h&f"}};
    data.signals = reports::signalsFromJson(
        R"({"friction_mae":0.018,"friction_mae_over_mean":0.1175,"height_ssim":null,"height_range_mm":0.4,
        "why":{"height_ssim":"no height maps"},"t_tests":[{"signal":"friction","unit":"fabric","n":7,"mean_difference":0.004,
        "statistic":1.2,"df":6,"p":0.27,"ci95":[-0.004,0.012],"tost":{"bounds":[-0.015,0.015],"p":0.012}}]})");
    int i = 0;
    for (reports::StudyResponse& r : data.responses) r.seconds = 3 + (i++ % 7);
    return data;
}

Json resultsOf(const reports::StudyData& data) { return reports::resultsJson(reports::analyse(data)); }

void writeReport(const reports::StudyData& data, const fs::path& folder) { reports::writeReport(reports::analyse(data), folder); }

}  // namespace

class ReportFilesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void reportHasItsFiles()
    {
        const fs::path report = path("report");
        writeReport(richStudy(), report);
        for (const char* name :
             {"index.html", "results.json", "statistics.json", "tables/overview.csv", "tables/overview.tex",
              "tables/comparisons_planned.csv", "tables/equivalence_q2.tex", "figures/matches_Q1.svg", "figures/ratings.svg"})
            QVERIFY2(fs::file_size(report / name) > 0, name);
        QCOMPARE(Json::parse(textOf(report / "results.json")), resultsOf(richStudy()));
        QCOMPARE(entriesOf(report),
                 (QStringList{"figures", "index.html", "reproduce", "results.json", "statistics.json", "tables"}));
    }

    /// Anything may lie in the place of an earlier report.
    void onlyWhatCanBeReadIsTakenForAnEarlierReport()
    {
        const fs::path file = path("results.json");
        const std::string begin = R"({"schema":"vis2hap.results/2","a":)";
        const auto isTaken = [&](const std::string& text) {
            std::ofstream(file, std::ios::binary) << text;
            return reports::isResultsFile(file);
        };
        QVERIFY(isTaken(begin + "[[1]]}"));
        QVERIFY(!isTaken(begin + std::string(150, '[') + std::string(150, ']') + "}"));
        QVERIFY(!isTaken("no JSON"));
        QVERIFY(!isTaken(begin + "1}" + std::string(protocols::largestJson, ' ')));
        QVERIFY(!reports::isResultsFile(path("missing")) && !reports::isResultsFile(file.parent_path()));
    }

    void figuresAreWellFormedAndWithoutOverlap()
    {
        writeReport(richStudy(), path("report"));
        for (const char* name : {"matches_Q1.svg", "ratings.svg"}) {
            QXmlStreamReader xml(QByteArray::fromStdString(textOf(path("report") / "figures" / name)));
            double width = 0;
            while (!xml.atEnd()) {
                if (xml.readNext() != QXmlStreamReader::StartElement) continue;
                if (xml.name() == QLatin1String("svg")) width = xml.attributes().value("width").toDouble();
                if (xml.name() == QLatin1String("text")) {
                    const double x = xml.attributes().value("x").toDouble();
                    QVERIFY(x >= 0 && x <= width);
                }
            }
            QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
        }
        const QString ratings = QString::fromStdString(textOf(path("report") / "figures" / "ratings.svg"));
        for (const char* group : {"vision", "generated", "measured"}) QVERIFY(ratings.contains(">" + QString(group) + "<"));
    }

    void pageIsSelfContainedAndSaysWhatItIs()
    {
        writeReport(richStudy(), path("report"));
        const QString html = page(path("report"));
        for (const char* foreign : {"<script", "<link", "@import", "url(", "<img"}) QVERIFY2(!html.contains(foreign), foreign);
        QVERIFY(html.contains("A &lt;study&gt; &amp; more") && !html.contains("<study>"));
        QCOMPARE(html.count("<span class=\"tag simulated\">SIMULATED participants</span>"), html.count("<section"));
        QVERIFY(html.count("<section") >= 9);
        QVERIFY(html.contains("The weights were trained on other fabrics."));
        QVERIFY(html.contains("reverses the meaning of the test"));
        QVERIFY(html.contains("equivalence not shown") && html.contains("difference not shown"));
        QVERIFY(!html.contains("not different"));
        QVERIFY(html.contains("no height maps"));
        QVERIFY(html.contains("chance: 3.3 of 10"));
        QVERIFY(!html.contains("nan") || !html.contains(">nan<"));
        QCOMPARE(html.count("<section"), html.count("</section>"));
        QCOMPARE(html.count("<table"), html.count("</table>"));
        QCOMPARE(html.count("<details"), html.count("</details>"));
        QVERIFY(!html.contains("tag blinded"));
    }

    /// What puts results in doubt stands at the head of the report, however many remarks there are.
    void graveRemarksComeFirst()
    {
        reports::StudyData data = richStudy();
        data.stamps = {"First remark.",
                       "Second remark.",
                       "Third remark.",
                       "Before the study: conditions h_g and f_g give the same image for F01.",
                       "2 sittings ran without a display: participants of these sittings felt no image on the glass.",
                       "The images of condition x come from a photograph that does not look like cloth."};
        const auto analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
        QStringList notices;
        for (const reports::DocumentNotice& notice : reports::reportDocument(analysis, {}, {}).notices)
            notices << QString::fromStdString(notice.html);
        const auto at = notices.indexOf(QString::fromStdString(data.stamps[3]));
        QVERIFY(at >= 0);
        QCOMPARE(notices.value(at + 1), QString::fromStdString(data.stamps[4]));
        QCOMPARE(notices.value(at + 2), QString::fromStdString(data.stamps[5]));
        QVERIFY(notices.value(at + 3).startsWith("3 more remarks on this study"));
        data.stamps.resize(4);
        const auto shorter = reports::analyse(data, {.depth = reports::Depth::Quick});
        notices.clear();
        for (const reports::DocumentNotice& notice : reports::reportDocument(shorter, {}, {}).notices)
            notices << QString::fromStdString(notice.html);
        QCOMPARE(notices.indexOf("First remark."), notices.indexOf(QString::fromStdString(data.stamps[3])) + 1);
        QVERIFY(!notices.contains("Second remark."));
    }

    /// A drawing is shrunk to the page and never enlarged.
    void figuresKeepTheirSize()
    {
        writeReport(richStudy(), path("report"));
        const QString html = page(path("report"));
        QVERIFY(html.contains("figure svg { height:auto; max-width:min(100%, 960px);"));
        QVERIFY(!html.contains("figure svg { width"));
    }

    void blindedPageNamesNoConditionAndNoGroup()
    {
        reports::StudyData data = richStudy();
        data.blinded = true;
        const auto masked = [](const std::string& condition) {
            const auto& all = builders::nineConditions;
            return "K" + std::to_string(std::find(all.begin(), all.end(), condition) - all.begin() + 1);
        };
        for (auto& condition : data.conditions) condition = masked(condition);
        for (auto& response : data.responses) response.condition = masked(response.condition);
        writeReport(data, path("report"));
        const QString html = page(path("report"));
        QCOMPARE(html.count("<span class=\"tag blinded\">blinded</span>"), html.count("<section"));
        for (const char* word :
             {"Planned contrast", "h_g", "vision", "measured signals</h2>", "<sub>grey", "comparisons_planned"})
            QVERIFY2(!html.contains(word), word);
        QVERIFY(!fs::exists(path("report") / "tables" / "comparisons_planned.csv"));
        QVERIFY(!fs::exists(path("report") / "tables" / "signals_t_tests.csv"));
    }

    void tablesReadBackAsTheNumbersOfTheResults()
    {
        writeReport(richStudy(), path("report"));
        const auto table = protocols::readForeignTable(path("report") / "tables" / "comparisons_q2.csv").table;
        const Json results = resultsOf(richStudy());
        std::size_t row = 0;
        for (const Json& expected : results["comparisons"]) {
            if (expected["question"] != "Q2") continue;
            QCOMPARE(table.rows[row][*table.column("b")], expected["b"].get<std::string>());
            QCOMPARE(protocols::numberAt(table, row, *table.column("p (Holm)")), expected["p_holm"].get<double>());
            QCOMPARE(protocols::numberAt(table, row, *table.column("95 % CI low")), expected["ci95"][0].get<double>());
            ++row;
        }
        QCOMPARE(row, table.rows.size());
        const QString tex = QString::fromStdString(textOf(path("report") / "tables" / "overview.tex"));
        QVERIFY(tex.contains("\\toprule") && tex.contains("\\bottomrule") &&
                tex.contains("$h_{\\mathrm{g}}$\\,\\&\\,$f_{\\mathrm{g}}$"));
    }

    void earlierReportIsReplacedAsAWhole()
    {
        const fs::path report = path("report");
        writeReport(richStudy(), report);
        std::ofstream(report / "notes.txt") << "mine";
        std::ofstream(report / "report.pdf") << "a document that the next report lacks";
        reports::StudyData smaller = richStudy();
        smaller.planned.clear();
        writeReport(smaller, report);
        QVERIFY(!fs::exists(report / "tables" / "comparisons_planned.csv"));
        QCOMPARE(textOf(report / "notes.txt"), std::string("mine"));
        QCOMPARE(entriesOf(report),
                 (QStringList{"figures", "index.html", "notes.txt", "reproduce", "results.json", "statistics.json", "tables"}));
    }

    void workOfSomebodyElseIsNotReplaced()
    {
        const fs::path report = path("report");
        fs::create_directories(report / "figures");
        std::ofstream(report / "figures" / "mine.svg") << "mine";
        QVERIFY_EXCEPTION_THROWN(writeReport(richStudy(), report), protocols::Error);
        QCOMPARE(entriesOf(report), QStringList{"figures"});
        QCOMPARE(textOf(report / "figures" / "mine.svg"), std::string("mine"));
    }

    void placeThatCannotHoldAFolderIsAnEnvironmentFault()
    {
        std::ofstream(path("file")) << "x";
        try {
            writeReport(richStudy(), path("file") / "report");
            QFAIL("the report was written");
        } catch (const protocols::Error& error) {
            QCOMPARE(error.exitCode(), protocols::ExitCode::Environment);
        }
        QVERIFY_EXCEPTION_THROWN(writeReport(richStudy(), path("file")), protocols::Error);
        QCOMPARE(textOf(path("file")), std::string("x"));
    }

    // A file system of 96 kB cannot hold the report. The test needs the right to mount it.
    void fullDiskLeavesTheEarlierReport()
    {
        const fs::path disk = path("disk");
        fs::create_directories(disk);
        const QString where = QString::fromStdString(disk.string());
        if (QProcess::execute("mount", {"-t", "tmpfs", "-o", "size=96k", "tmpfs", where}) != 0)
            QSKIP("no right to mount a small file system: the full disk was not tried");
        fs::create_directories(disk / "report");
        std::ofstream(disk / "report" / "results.json") << R"({"schema":"vis2hap.results/1"})";
        bool refused = false;
        try {
            writeReport(richStudy(), disk / "report");
        } catch (const protocols::Error& error) {
            refused = error.exitCode() == protocols::ExitCode::Environment;
        }
        const QStringList left = entriesOf(disk / "report");
        const std::string kept = textOf(disk / "report" / "results.json");
        QProcess::execute("umount", {where});
        QVERIFY(refused);
        QCOMPARE(left, QStringList{"results.json"});
        QCOMPARE(kept, std::string(R"({"schema":"vis2hap.results/1"})"));
    }

    void emptyAndOddStudiesStillMakeAReport_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<QStringList>("conditions");
        QTest::newRow("nobody yet") << 0 << QStringList{"f", "h"};
        QTest::newRow("one condition") << 3 << QStringList{"f"};
        QTest::newRow("long names") << 2
                                    << QStringList{"a very long name of a condition", "another <one>", "Bedingung Größe", "d",
                                                   "e"};
    }

    void emptyAndOddStudiesStillMakeAReport()
    {
        QFETCH(int, participants);
        QFETCH(QStringList, conditions);
        std::vector<std::string> names;
        for (const QString& name : conditions) names.push_back(name.toStdString());
        const auto data =
            builders::study(participants, 3, names,
                            {[](int p, int f, int) { return (p + f) % 2 == 0; },
                             [](int p, int f, int c, int q) { return (30 + (p * 5 + f * 7 + c * 3 + q) % 40) / 10.0; }});
        writeReport(data, path("report"));
        QXmlStreamReader xml(QByteArray::fromStdString(textOf(path("report") / "figures" / "matches_Q1.svg")));
        while (!xml.atEnd()) xml.readNext();
        QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
    }

private:
    fs::path path(const char* name) const { return fs::path(m_folder->path().toStdString()) / name; }

    static QStringList entriesOf(const fs::path& folder)
    {
        QStringList names;
        for (const auto& entry : fs::directory_iterator(folder))
            names << QString::fromStdString(entry.path().filename().string());
        names.sort();
        return names;
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

QTEST_GUILESS_MAIN(ReportFilesTest)
#include "report_files_test.moc"
