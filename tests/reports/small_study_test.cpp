// Every number of a small study's report. results.json and statistics.json are compared with small_study/expected.json, which
// small_study/expected.R computes from answers.csv. tables.txt and figures/ are kept outputs; the numbers that version 0.5.0 had
// are unchanged.
#include <QRegularExpression>
#include <QTest>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/charts/plot_frame.h"
#include "reports/data/answers_csv.h"
#include "reports/figures/report_figures.h"
#include "reports/formats/table_formats.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"

using Json = nlohmann::ordered_json;

namespace {

std::filesystem::path fixture(const std::string& name)
{
    return std::filesystem::path(VIS2HAP_SOURCE_DIR) / "tests" / "reports" / "small_study" / name;
}

/// With VIS2HAP_KEEP=1 the outputs of this run become the kept ones; read the difference before you commit it.
void keepIfAsked(const std::string& name, const QString& text)
{
    if (!qEnvironmentVariableIsSet("VIS2HAP_KEEP")) return;
    std::filesystem::create_directories(fixture(name).parent_path());
    std::ofstream(fixture(name), std::ios::binary) << text.toStdString();
}

QString textOf(const std::string& name)
{
    std::ifstream stream(fixture(name), std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return QString::fromStdString(text.str());
}

const reports::StudyAnalysis& smallStudy()
{
    static const reports::StudyAnalysis analysis = reports::analyse(reports::readAnswersCsv(fixture("answers.csv")));
    return analysis;
}

/// Relative agreement with R. Mixed models are fitted, not computed: lme4 stops at another distance from the optimum. The
/// standard errors of the logistic model come from a Hessian at fixed modes here, from differences of the criterion in R.
double toleranceOf(const QString& path)
{
    if (path.contains("q1_glmm.se")) return 1.5e-2;
    // glmer stops at another distance from the optimum of four variances; its log likelihood agrees to 1e-9.
    if (path.contains("r_squared.Q1") || path.contains("variance_components.Q1")) return 1e-3;
    if (path.contains("r_squared") || path.contains("variance_components") || path.contains(".clustered")) return 1e-5;
    if (path.contains("bf10")) return 1e-6;  // adaptive quadrature in R
    if (path.contains("q1_glmm") || path.contains(".lmm.")) return 2e-6;
    return 1e-10;
}

/// Differences of an answer from what is expected; every number of the answer must be expected.
class Comparison {
public:
    void compare(const Json& expected, const Json& answer, const QString& path)
    {
        if (expected.is_object()) {
            if (!answer.is_object()) return fault(path, "is no object");
            for (const auto& [key, value] : expected.items()) {
                const QString place = path + "." + QString::fromStdString(key);
                if (answer.contains(key))
                    compare(value, answer[key], place);
                else
                    fault(place, "is missing");
            }
            for (const auto& [key, value] : answer.items())
                if (!expected.contains(key) && key.find("generalises_to") == std::string::npos)
                    additions << path + "." + QString::fromStdString(key);
        } else if (expected.is_array()) {
            if (!answer.is_array() || answer.size() != expected.size()) return fault(path, "differs in length");
            for (std::size_t i = 0; i < expected.size(); ++i)
                compare(expected[i], answer[i], path + "[" + QString::number(i) + "]");
        } else if (expected.is_number()) {
            ++numbers;
            const double a = answer.is_number() ? answer.get<double>() : NAN, e = expected.get<double>();
            if (!(std::fabs(a - e) <= toleranceOf(path) * std::fabs(e) + 1e-14))
                fault(path, QString("%1 for %2").arg(a, 0, 'g', 17).arg(e, 0, 'g', 17));
        } else if (expected != answer) {
            fault(path, QString::fromStdString(answer.dump() + " for " + expected.dump()));
        }
    }

    int numbers = 0;
    QStringList faults;
    QStringList additions;  ///< keys that are not expected; marks of what a test generalises to have tests of their own

private:
    void fault(const QString& path, const QString& what) { faults << path + ": " + what; }
};

/// Replaces every number by # and returns the numbers.
QList<double> numbersTakenFrom(QString& text)
{
    static const QRegularExpression number("-?[0-9]+(\\.[0-9]+)?");
    QList<double> numbers;
    for (auto it = number.globalMatch(text); it.hasNext();) numbers << it.next().captured().toDouble();
    text.replace(number, "#");
    return numbers;
}

}  // namespace

class SmallStudyTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void resultsAgreeWithR()
    {
        const Json expected = Json::parse(textOf("expected.json").toStdString());
        Comparison comparison;
        comparison.compare(expected["results"], reports::resultsJson(smallStudy()), "results");
        QCOMPARE(comparison.faults, QStringList());
        QCOMPARE(comparison.additions,
                 (QStringList{"results.schema", "results.study", "results.conditions", "results.omnibus", "results.above_chance",
                              "results.claims", "results.chain", "results.signals", "results.quality", "results.preregistration",
                              "results.without_flagged", "results.design", "results.touch", "results.operator_latency",
                              "results.why"}));
        QCOMPARE(comparison.numbers, 228);
    }

    void statisticsAgreeWithR()
    {
        const Json expected = Json::parse(textOf("expected.json").toStdString());
        Comparison comparison;
        comparison.compare(expected["statistics"], reports::statisticsJson(smallStudy()), "statistics");
        QCOMPARE(comparison.faults, QStringList());
        // expected.json has no facts of the data and no response times of Q2 and Q3.
        comparison.additions.erase(std::remove_if(comparison.additions.begin(), comparison.additions.end(),
                                                  [](const QString& key) {
                                                      return key.startsWith("statistics.data.") ||
                                                             key.startsWith("statistics.response_times.Q2.") ||
                                                             key.startsWith("statistics.response_times.Q3.");
                                                  }),
                                   comparison.additions.end());
        QCOMPARE(comparison.additions,
                 (QStringList{"statistics.q1_cochran.rejects_falsely", "statistics.Q2.on_common_fabrics",
                              "statistics.Q3.on_common_fabrics", "statistics.schema", "statistics.q1_glmm_crossed",
                              "statistics.lmm_contrasts", "statistics.lmm_variances", "statistics.lmm_leave_one_fabric_out",
                              "statistics.rating_ordinal", "statistics.rating_ordinal_by_question", "statistics.false_claims",
                              "statistics.order_effects"}));
        QCOMPARE(comparison.numbers, 710);
    }

    void flagsCarryTheirNumbers()
    {
        QStringList lines;
        for (const reports::QualityFlag& flag : smallStudy().flags)
            lines << QString::fromStdString(flag.participant.value_or("all") + " " + nameOf(flag.kind) + ": " + flag.why);
        QCOMPARE(
            lines,
            (QStringList{"P2 missing_answers: answers missing: Q2: 1 of 12",
                         "P2 too_fast: 1 of 12 answers (8 %) came within 0.5 s of the touch",
                         "P3 missing_answers: answers missing: Q1: 1 of 12", "P4 missing_answers: answers missing: Q2: 1 of 12",
                         "P5 missing_answers: answers missing: Q3: 1 of 12", "P6 straight_lining: Q3: 7 of 12 ratings are 5"}));
    }

    void tablesAreThoseThatAreKept()
    {
        QString text;
        for (const reports::ReportTable& one : reports::reportTables(smallStudy()))
            text += "=== " + QString::fromStdString(one.table.name + "\n" + reports::toText(one.table));
        keepIfAsked("tables.txt", text);
        const QStringList lines = text.split('\n'), kept = textOf("tables.txt").split('\n');
        for (int i = 0; i < std::min(lines.size(), kept.size()); ++i) QCOMPARE(lines[i], kept[i]);
        QCOMPARE(lines.size(), kept.size());
    }

    /// The CSV has all digits of every number that the page rounds.
    void filesOfTablesHoldTheSameNumbers()
    {
        int compared = 0;
        for (const reports::ReportTable& one : reports::reportTables(smallStudy()))
            for (const auto& row : one.table.rows)
                for (const reports::TableCell& cell : row) {
                    bool isText = false, isCsv = false;
                    const QString text = QString::fromStdString(cell.text);
                    const double shown = text.toDouble(&isText), full = QString::fromStdString(cell.csv).toDouble(&isCsv);
                    if (!isText || !isCsv) continue;
                    const int decimals = text.contains('.') ? static_cast<int>(text.size() - text.indexOf('.') - 1) : 0;
                    QVERIFY2(std::fabs(shown - full) <= 0.5000001 * std::pow(10.0, -decimals), qPrintable(text));
                    ++compared;
                }
        QVERIFY(compared > 300);
    }

    void figuresAreThoseThatAreKept()
    {
        QStringList names;
        for (const reports::Figure& figure : reports::reportFigures(smallStudy())) {
            names << QString::fromStdString(figure.name);
            keepIfAsked("figures/" + figure.name + ".svg", QString::fromStdString(figure.svg));
            QString drawn = QString::fromStdString(figure.svg), kept = textOf("figures/" + figure.name + ".svg");
            static const QRegularExpression description("<desc>[^<]*</desc>\n");
            drawn.remove(description);
            kept.remove(description);
            const QList<double> numbers = numbersTakenFrom(drawn), keptNumbers = numbersTakenFrom(kept);
            QCOMPARE(drawn, kept);
            for (int i = 0; i < numbers.size(); ++i)  // a tenth of a pixel may round either way
                QVERIFY2(std::fabs(numbers[i] - keptNumbers[i]) < 0.11, qPrintable(names.last() + QString::number(i)));
        }
        QCOMPARE(names, (QStringList{"matches_Q1", "ratings", "confusion_Q1", "by_fabric_Q2", "by_fabric_Q3", "participants_Q2",
                                     "participants_Q3", "contrasts_Q1", "contrasts_Q2", "contrasts_Q3", "speed_accuracy_Q1",
                                     "conditional_accuracy_Q1"}));
    }

    void captionsSayWhatIsDrawn()
    {
        const auto figures = reports::reportFigures(smallStudy());
        QCOMPARE(
            figures[0].caption,
            std::string(
                "Q1: correct matches per rendering, of 6 participants. Bars: mean share correct times the number of "
                "participants. Whiskers: its 95 % interval with participants and fabrics as samples. Dashed line: chance, 1/3."));
        QCOMPARE(figures[1].caption,
                 std::string("Ratings by condition and question: means of the participants' means, with their 95 % interval."));
    }

    /// An end of a whisker beyond the axis has no cap, because the interval does not end there.
    void whiskersThatAreCutHaveNoCap_data()
    {
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<int>("lines");
        QTest::newRow("inside") << 0.2 << 0.8 << 3;
        QTest::newRow("ends of the axis") << 0.0 << 1.0 << 3;
        QTest::newRow("below") << -0.1 << 0.8 << 2;
        QTest::newRow("above") << 0.2 << 1.1 << 2;
        QTest::newRow("both") << -0.1 << 1.1 << 1;
    }

    void whiskersThatAreCutHaveNoCap()
    {
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(int, lines);
        reports::PlotFrame plot({"f"}, 0, 1, "", "");
        plot.drawErrorBar(100, {low, high}, "#123456");
        QCOMPARE(QString::fromStdString(plot.drawing().finished()).count("stroke=\"#123456\""), lines);
    }

    /// Colours look alike in grey, and a caption names no line that is missing.
    void captionsNameShapesThatAreDrawn()
    {
        reports::StudyData data = smallStudy().data;
        const auto captionOf = [&](const std::string& name) {
            for (const reports::Figure& figure : reports::reportFigures(reports::analyse(data, {.depth = reports::Depth::Quick})))
                if (figure.name == name) return QString::fromStdString(figure.caption);
            return QString("no figure");
        };
        QCOMPARE(captionOf("participants_Q2"),
                 QString("Q2: the mean of each of 6 participants under each condition (small points, joined by lines). Large "
                         "points: their mean, with the 95 % within-participant interval (Morey)."));
        QVERIFY(captionOf("speed_accuracy_Q1").contains("Line: share correct by response time"));
        // One answer with a time has no quarters of times.
        bool isFirst = true;
        for (reports::StudyResponse& response : data.responses) {
            const bool keeps = isFirst && response.question == "Q1" && response.seconds;
            if (!keeps) response.seconds.reset();
            isFirst = isFirst && !keeps;
        }
        QVERIFY(captionOf("speed_accuracy_Q1").contains("Numbered points: "));
        QVERIFY(!captionOf("speed_accuracy_Q1").contains("Line: "));
    }

    void pageShowsEveryFigureAndTable()
    {
        const auto tables = reports::reportTables(smallStudy());
        const auto figures = reports::reportFigures(smallStudy());
        const std::string page = reports::reportPage(smallStudy(), tables, figures);
        for (const reports::ReportTable& one : tables) {
            const std::size_t at = page.find(reports::toHtml(one.table));
            QVERIFY2(at != std::string::npos && page.find(reports::toHtml(one.table), at + 1) == std::string::npos,
                     one.table.name.c_str());
        }
        for (const reports::Figure& figure : figures) QVERIFY2(page.find(figure.svg) != std::string::npos, figure.name.c_str());
    }

    void pageStatesTheFindings_data()
    {
        QTest::addColumn<QString>("sentence");
        QTest::newRow("matches") << "Q1: matches per rendering range from 2.2 (v<sub>grey</sub>) to 4.2 (h&f).";
        QTest::newRow("chance")
            << "Q1: matching is shown to be above chance (1/3) in 1 of 3 conditions for fabrics like these: "
               "h<sub>g</sub>&f<sub>g</sub>. For these fabrics only it is in 2: h<sub>g</sub>&f<sub>g</sub> and h&f.";
        QTest::newRow("Q2") << "Q2: mean ratings range from 4.2 (v<sub>grey</sub>) to 7.1 (h&f).";
        QTest::newRow("Q3") << "Q3: mean ratings range from 5.4 (v<sub>grey</sub>) to 6.7 (h&f).";
        QTest::newRow("contrast")
            << "Q2, primary contrast h&f \u2212 h<sub>g</sub>&f<sub>g</sub>: 1.54, 90 % interval [0.08, 3.00]. For fabrics like "
               "these: <b>not decided</b> (p of the difference = .087, of equivalence";
    }

    void pageStatesTheFindings()
    {
        QFETCH(QString, sentence);
        reports::StudyData data = smallStudy().data;
        data.planned = {{"h&f", "h_g&f_g"}};
        QString page = QString::fromStdString(reports::reportPage(reports::analyse(data), {}, {}));
        page.remove("<span class=\"cond\">").remove("</span>").remove("<i>").remove("</i>").replace("&amp;", "&");
        QVERIFY2(page.contains(sentence), qPrintable(page.mid(page.indexOf("<ul class=\"findings"), 4000)));
    }
};

QTEST_GUILESS_MAIN(SmallStudyTest)
#include "small_study_test.moc"
