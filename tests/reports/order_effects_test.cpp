// Response times, speed and accuracy, and effects of order in the report.
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "reports/cells/response_time.h"
#include "reports/figures/report_figures.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"
#include "tests/reports/study_builder.h"

using Json = nlohmann::ordered_json;
using namespace reports;

namespace {

const AnalysisOptions quick{Depth::Quick, {}};

struct Planted {
    double learning = 0;    ///< rating points for 10 trials
    double quickening = 0;  ///< logarithm of the time for 10 trials
    double secondSitting = 0;
    unsigned seed = 1;
};

/// 10 participants, 7 fabrics, 9 conditions; each participant has an order of its own. Two sittings.
StudyData plantedStudy(const Planted& planted)
{
    std::mt19937 bits(planted.seed);
    std::normal_distribution<double> normal;
    StudyData data = builders::emptyStudy(10, 7, builders::nineConditions,
                                          {{"Q1", "Which?", builders::amongThree}, {"Q2", "How alike?", builders::onScale}});
    for (const std::string& participant : data.participants) {
        std::vector<int> order(63);
        for (int i = 0; i < 63; ++i) order[static_cast<std::size_t>(i)] = i;
        std::shuffle(order.begin(), order.end(), bits);
        const double level = normal(bits);
        for (int i = 0; i < 63; ++i) {
            const int cell = order[static_cast<std::size_t>(i)], c = cell / 7, f = cell % 7;
            const std::string &fabric = data.fabrics[static_cast<std::size_t>(f)],
                              &condition = data.conditions[static_cast<std::size_t>(c)];
            const double tens = i / 10.0;
            StudyResponse match = builders::right(participant, fabric, condition, "Q1", normal(bits) + c * 0.1 > 0);
            match.seconds = std::exp(1.5 + planted.quickening * tens + 0.3 * normal(bits));
            StudyResponse rating = builders::rated(
                participant, fabric, condition, "Q2",
                5 + level + 0.2 * c - 0.3 * f + planted.learning * tens + (i >= 32 ? planted.secondSitting : 0) + normal(bits));
            rating.seconds = std::exp(1 + 0.3 * normal(bits));
            match.trial = i + 1;
            rating.trial = 64 + i;
            match.sitting = rating.sitting = i < 32 ? 1 : 2;
            data.responses.push_back(match);
            data.responses.push_back(rating);
        }
    }
    return data;
}

/// 10 participants, 7 fabrics, 3 conditions, first all of them under "speed", then all under "accuracy": slower, more often right
/// and rated higher. Within a block nothing changes over the trials or with the time.
StudyData instructedBlocks()
{
    std::mt19937 bits(4);
    std::normal_distribution<double> normal;
    StudyData data = builders::emptyStudy(10, 7, {"A", "B", "C"},
                                          {{"Q1", "Which?", builders::amongThree}, {"Q2", "How alike?", builders::onScale}});
    data.answersPerCell = 2;
    for (QuestionInfo& question : data.questions)
        for (const char* id : {"speed", "accuracy"}) question.instructions.push_back({id});
    for (const std::string& participant : data.participants)
        for (const bool isFast : {true, false}) {
            std::vector<int> order(21);
            for (int i = 0; i < 21; ++i) order[static_cast<std::size_t>(i)] = i;
            std::shuffle(order.begin(), order.end(), bits);
            for (int i = 0; i < 21; ++i) {
                const auto cell = static_cast<std::size_t>(order[static_cast<std::size_t>(i)]);
                const std::string &fabric = data.fabrics[cell % 7], &condition = data.conditions[cell / 7];
                StudyResponse match =
                    builders::right(participant, fabric, condition, "Q1", normal(bits) < (isFast ? -0.25 : 1.3));
                match.seconds = std::exp((isFast ? 0.7 : 1.8) + 0.2 * normal(bits));
                StudyResponse rating =
                    builders::rated(participant, fabric, condition, "Q2", (isFast ? 5 : 6.5) + 0.5 * normal(bits));
                for (StudyResponse* response : {&match, &rating}) {
                    response->trial = (isFast ? 1 : 22) + i;
                    response->instruction = response->repetition = isFast ? "speed" : "accuracy";
                    data.responses.push_back(*response);
                }
            }
        }
    return data;
}

/// The answers as if nobody had instructed the participants.
StudyData withoutInstructions(StudyData data)
{
    for (QuestionInfo& question : data.questions) question.instructions.clear();
    for (StudyResponse& response : data.responses) response.instruction.clear();
    return data;
}

const OrderEffect& effectOf(const StudyAnalysis& analysis, std::size_t question, OrderEffectKind kind)
{
    return analysis.order.questions.at(question).effects.at(static_cast<std::size_t>(kind));
}

std::string pageOf(const StudyAnalysis& analysis)
{
    return reportPage(analysis, reportTables(analysis), reportFigures(analysis));
}

}  // namespace

class OrderEffectsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// The definition of the response time will change. So one function reads the recorded seconds.
    void onlyOneFunctionReadsTheSeconds()
    {
        static const QRegularExpression reading("(\\.|->)seconds\\b(?!\\s*=[^=])");
        QStringList readers;
        const QString root = QString(VIS2HAP_SOURCE_DIR) + "/reports/";
        QDirIterator files(root, {"*.cpp", "*.h"}, QDir::Files, QDirIterator::Subdirectories);
        int count = 0;
        while (files.hasNext()) {
            QFile file(files.next());
            QVERIFY(file.open(QIODevice::ReadOnly));
            const QString path = file.fileName().mid(root.size());
            ++count;
            if (reading.match(QString::fromUtf8(file.readAll())).hasMatch()) readers << path;
        }
        QVERIFY(count > 80);
        QCOMPARE(readers, QStringList{"cells/response_time.cpp"});
    }

    void plantedLearningIsFound()
    {
        const StudyAnalysis analysis =
            analyse(plantedStudy({.learning = 0.3, .quickening = -0.05, .secondSitting = 0, .seed = 3}), quick);
        const stats::TTest& rating = effectOf(analysis, 1, OrderEffectKind::Trend).trend.test;
        QVERIFY(*rating.ci.low > 0 && *rating.ci.low < 0.3 && *rating.ci.high > 0.3);
        const stats::TTest& time = effectOf(analysis, 0, OrderEffectKind::TimeTrend).trend.test;
        QVERIFY(*time.ci.high < 0 && *time.ci.low < -0.05 && *time.ci.high > -0.05);
        const stats::TTest& choices = effectOf(analysis, 0, OrderEffectKind::Trend).trend.test;
        QVERIFY(!excludesZero(choices));
        const std::string page = pageOf(analysis);
        QVERIFY(page.find("Q2: ratings change by 0.") != std::string::npos);
        QVERIFY(page.find("Q1: response times change by \u2212") != std::string::npos);
        QVERIFY(page.find("Q1: the share correct changes by") == std::string::npos);
        QVERIFY(page.find("Each interval excludes 0 by chance") != std::string::npos);
    }

    void aJumpBetweenSittingsIsFound()
    {
        const StudyAnalysis analysis =
            analyse(plantedStudy({.learning = 0, .quickening = 0, .secondSitting = 1, .seed = 1}), quick);
        const stats::TTest& jump = effectOf(analysis, 1, OrderEffectKind::LaterSittings).trend.test;
        QCOMPARE(jump.n, std::size_t(10));
        QVERIFY(*jump.ci.low > 0 && *jump.ci.low < 1 && *jump.ci.high > 1);
    }

    /// Fast and careless blocks before slow and careful ones are neither learning, nor a proof that slower answers are better.
    void anInstructionIsNoTrend()
    {
        const auto trendsOf = [](const StudyAnalysis& analysis) {
            return std::vector<stats::TTest>{effectOf(analysis, 0, OrderEffectKind::Trend).trend.test,
                                             effectOf(analysis, 1, OrderEffectKind::Trend).trend.test,
                                             effectOf(analysis, 0, OrderEffectKind::TimeTrend).trend.test,
                                             questionsWith<ChoiceAnalysis>(analysis).front().findings.accuracyBySpeed.trend.test};
        };
        const StudyAnalysis instructed = analyse(instructedBlocks(), quick);
        for (const stats::TTest& test : trendsOf(instructed)) {
            QCOMPARE(test.n, std::size_t(10));
            QVERIFY2(!excludesZero(test), qPrintable(QString::number(*test.estimate)));
        }
        const std::string page = pageOf(instructed);
        for (const char* part :
             {"]), at equal condition, instruction and fabric.",
              "Changes over trials and sittings within participants, at equal condition, instruction and fabric",
              "with effects of each condition under each instruction, and of fabric",
              "so its trend is that at equal condition, instruction and fabric."})
            QVERIFY2(page.find(part) != std::string::npos, part);
        QVERIFY(page.find(" over 10 trials.") == std::string::npos);

        const StudyAnalysis plain = analyse(withoutInstructions(instructedBlocks()), quick);
        for (const stats::TTest& test : trendsOf(plain)) QVERIFY(excludesZero(test));
        QVERIFY(pageOf(plain).find(" over 10 trials.") != std::string::npos);
        QVERIFY(pageOf(plain).find("]), at equal condition and fabric.") != std::string::npos);
        QVERIFY(pageOf(plain).find("with effects of condition and fabric.") != std::string::npos);
    }

    /// A contrast that the order favours shrinks by what the trend gave it.
    void theContrastIsShownWithoutTheTrend()
    {
        StudyData data = plantedStudy({});
        data.planned = {{"h&f", "v_grey"}};
        int tie = 0;
        for (StudyResponse& one : data.responses) {
            if (one.question != "Q2") continue;
            // The first half of the session has no h&f, the second no v_grey; the answers only rise over the trials.
            const bool late = one.condition == "h&f", early = one.condition == "v_grey";
            one.trial = late ? 57 + tie % 7 : early ? 1 + tie % 7 : *one.trial;
            ++tie;
            one.content = RatedAnswer{5 + 0.05 * *one.trial};
        }
        const StudyAnalysis analysis = analyse(data, quick);
        const ContrastWithoutTrend& contrast = analysis.order.questions[1].contrast;
        QVERIFY(contrast.primary);
        QVERIFY(*contrast.plain.estimate > 2.5);
        QVERIFY(std::fabs(*contrast.adjusted.estimate) < 1e-9);
        const Json json = statisticsJson(analysis)["order_effects"]["questions"]["Q2"]["contrast"];
        QCOMPARE(json["a"], "h&f");
        QVERIFY(json["difference"]["estimate"].get<double>() > 2.5);
    }

    /// The largest of several differences is large by chance, too: its p and interval are those of so many tests.
    void theLargestContrastIsCorrected()
    {
        StudyData data = plantedStudy({});
        const StudyAnalysis unplanned = analyse(data, quick);
        const ContrastWithoutTrend& largest = unplanned.order.questions[1].contrast;
        const std::size_t pairs = data.conditions.size() * (data.conditions.size() - 1) / 2;
        QVERIFY(!largest.primary && pairs > 1);
        QCOMPARE(largest.pickedFrom, pairs);
        data.planned = {{largest.a, largest.b}};
        const StudyAnalysis planned = analyse(data, quick);
        const ContrastWithoutTrend& primary = planned.order.questions[1].contrast;
        QCOMPARE(primary.pickedFrom, std::size_t(1));
        QVERIFY(std::fabs(*largest.plain.p - std::min(1.0, double(pairs) * *primary.plain.p)) < 1e-12);
        QVERIFY(std::fabs(*largest.adjusted.p - std::min(1.0, double(pairs) * *primary.adjusted.p)) < 1e-12);
        QCOMPARE(*largest.plain.estimate, *primary.plain.estimate);
        QVERIFY(*largest.plain.ci.low<*primary.plain.ci.low&& * largest.plain.ci.high> * primary.plain.ci.high);
        QVERIFY(pageOf(unplanned).find("picked from: " + std::to_string(pairs) + " for Q1") != std::string::npos);
        QVERIFY(pageOf(planned).find("picked from: ") == std::string::npos);
        QCOMPARE(statisticsJson(unplanned)["order_effects"]["questions"]["Q2"]["contrast"]["picked_from"], pairs);
    }

    void filesHoldTheNewParts()
    {
        StudyData data = plantedStudy({});
        data.planned = {{"h&f", "v_grey"}, {"f", "h"}};
        const StudyAnalysis analysis = analyse(data, quick);
        const Json results = resultsJson(analysis), statistics = statisticsJson(analysis);
        const Json& speed = results["speed_accuracy"]["h&f"];
        for (const char* pair : {"bits_per_second", "bis"}) {
            const Json& interval = speed[std::string(pair) + "_ci95"];
            QVERIFY(interval[0].get<double>() < speed[pair].get<double>());
            QVERIFY(interval[1].get<double>() > speed[pair].get<double>());
        }
        QCOMPARE(statistics["q1_speed_accuracy_contrasts"]["contrasts"].size(), std::size_t(6));
        QCOMPARE(statistics["q1_speed_accuracy_contrasts"]["contrasts"][0]["measure"], "bits_per_second");
        QCOMPARE(statistics["q1_speed_accuracy_contrasts"]["contrasts"][0]["primary"], true);
        QCOMPARE(statistics["q1_conditional_accuracy"]["bins"].size(), std::size_t(4));
        QCOMPARE(statistics["q1_conditional_accuracy"]["conditions"]["f"].size(), std::size_t(2));
        QCOMPARE(statistics["order_effects"]["questions"]["Q2"]["trend_per_10_trials"]["n"], 10);
        const auto figures = reportFigures(analysis);
        QVERIFY(std::ranges::any_of(figures, [](const Figure& one) { return one.name == "conditional_accuracy_Q1"; }));
    }

    void whatIsMissingHasAReason()
    {
        StudyData data = plantedStudy({});
        for (StudyResponse& one : data.responses) {
            one.seconds = {};
            one.trial = {};
            one.sitting = {};
        }
        const Json bare = statisticsJson(analyse(data, quick));
        QCOMPARE(bare["order_effects"]["why"]["questions"], "the answers do not say when they were given");
        QCOMPARE(bare["q1_conditional_accuracy"]["why"]["bins"], "there are no response times");
        QCOMPARE(bare["q1_speed_accuracy_contrasts"]["why"]["contrasts"], "there are no response times");
        for (StudyResponse& one : data.responses) one.sitting = 1;
        const Json sat = statisticsJson(analyse(data, quick));
        const Json& rows = sat["order_effects"]["questions"]["Q2"];
        QCOMPARE(rows["trend_per_10_trials"]["why"]["p"], "the answers have no trial numbers");
        QCOMPARE(rows["later_minus_first_sitting"]["why"]["p"], "every participant answered in one sitting");
    }

    /// Extremes: every report is made, and no number stands where none can be known.
    void extremesAreReported_data()
    {
        QTest::addColumn<QString>("what");
        for (const char* what : {"one participant", "one fabric", "one row", "two conditions", "all right", "all wrong",
                                 "constant", "equal times", "30 % missing", "zero times"})
            QTest::newRow(what) << what;
    }

    void extremesAreReported()
    {
        QFETCH(QString, what);
        StudyData data = plantedStudy({});
        const auto keep = [&](const auto& isKept) {
            std::erase_if(data.responses, [&](const StudyResponse& one) { return !isKept(one); });
        };
        if (what == "one participant") {
            data.participants.resize(1);
            keep([&](const StudyResponse& one) { return one.participant == data.participants[0]; });
        } else if (what == "one fabric") {
            data.fabrics.resize(1);
            keep([&](const StudyResponse& one) { return one.fabric == data.fabrics[0]; });
        } else if (what == "one row") {
            bool first = true;
            keep([&](const StudyResponse& one) {
                return one.participant != "P10" || one.question != "Q1" || std::exchange(first, false);
            });
        } else if (what == "two conditions") {
            data.conditions.resize(2);
            keep([&](const StudyResponse& one) {
                return one.condition == data.conditions[0] || one.condition == data.conditions[1];
            });
        } else if (what == "30 % missing") {
            int i = 0;
            keep([&](const StudyResponse&) { return i++ % 10 >= 3; });
        }
        for (StudyResponse& one : data.responses) {
            if (one.question == "Q1" && what.startsWith("all")) one.content = ChosenAnswer{what == "all right", {}, {}};
            if (one.question == "Q2" && what == "constant") one.content = RatedAnswer{10};
            if (what == "equal times") one.seconds = 4;
            if (what == "zero times") one.seconds = 0;
        }
        const StudyAnalysis analysis = analyse(data, quick);
        const Json statistics = statisticsJson(analysis), results = resultsJson(analysis);
        QVERIFY(!pageOf(analysis).empty());
        QVERIFY(statistics.dump().find("nan") == std::string::npos);
        if (what == "constant") QVERIFY(statistics["order_effects"]["questions"]["Q2"]["trend_per_10_trials"]["p"].is_null());
        if (what == "one participant") {
            QVERIFY(results["speed_accuracy"]["f"]["bits_per_second_ci95"].is_null());
            QVERIFY(!results["speed_accuracy"]["f"]["why"]["bits_per_second_ci95"].get<std::string>().empty());
            QVERIFY(statistics["q1_conditional_accuracy"]["bins"][0]["ci95"].is_null());
        }
        if (what == "all right") QVERIFY(results["speed_accuracy"]["f"]["bits_per_second_ci95"].is_null());
        if (what == "equal times") QVERIFY(statistics["q1_conditional_accuracy"]["trend"]["p"].is_null());
        if (what == "one row") QCOMPARE(analysis.order.questions[0].effects[0].trend.test.n, std::size_t(9));
    }
};

QTEST_GUILESS_MAIN(OrderEffectsTest)
#include "order_effects_test.moc"
