// Ratings as ordered categories in the report: how they are rounded, where the model stands, and what cannot be fitted.
#include "reports/analysis/ordinal_ratings.h"

#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/json/statistics_json.h"
#include "reports/tables/report_tables.h"
#include "tests/reports/study_builder.h"

using Json = nlohmann::ordered_json;

namespace {

reports::StudyData rating(double low, double high, const std::function<double(int, int, int, int)>& answer)
{
    reports::StudyData data =
        builders::study(4, 3, {"a", "b", "c"}, {[](int p, int, int c) { return (p + c) % 2 == 0; }, answer});
    protocols::Rating kind;
    kind.scale.min = protocols::Tenths{static_cast<int>(std::lround(low * 10))};
    kind.scale.max = protocols::Tenths{static_cast<int>(std::lround(high * 10))};
    for (reports::QuestionInfo& question : data.questions)
        if (question.id != "Q1") question.kind = kind;
    return data;
}

/// Ratings that vary within all conditions, as a share of the scale.
double share(int p, int f, int c, int q) { return (p * 5 + f * 3 + c * 4 + q) % 11 / 10.0; }

const reports::Table* ordinalTable(const std::vector<reports::ReportTable>& tables)
{
    for (const reports::ReportTable& one : tables)
        if (one.table.name == "ordinal_models") return &one.table;
    return nullptr;
}

}  // namespace

class OrdinalRatingsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theUnitFollowsTheScale_data()
    {
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<double>("unit");
        QTest::addColumn<QString>("words");
        const auto row = [](double low, double high, double unit, const char* words) {
            QTest::addRow("%g to %g", low, high) << low << high << unit << words;
        };
        row(0, 10, 1, "to whole numbers, halves up");
        row(1, 7, 1, "to whole numbers, halves up");
        row(1, 3, 1, "to whole numbers, halves up");
        row(0, 20, 1, "to whole numbers, halves up");
        row(0, 100, 10, "to multiples of 10, halves up");
        row(-50, 10, 5, "to multiples of 5, halves up");
        row(0, 1, 0.1, "to multiples of 0.1, halves up");
        row(0, 1.5, 0.1, "to multiples of 0.1, halves up");
        row(0, 30, 2, "to multiples of 2, halves up");
        row(5, 5, 1, "to whole numbers, halves up");
    }

    void theUnitFollowsTheScale()
    {
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(double, unit);
        QFETCH(QString, words);
        QCOMPARE(reports::roundingUnit({low, high}), unit);
        QCOMPARE(QString::fromStdString(reports::roundingWords(unit)), words);
    }

    void theLastQuestionStandsAlone()
    {
        const auto analysis = reports::analyse(rating(0, 10, [](int p, int f, int c, int q) { return 10 * share(p, f, c, q); }));
        const Json statistics = reports::statisticsJson(analysis);
        QCOMPARE(statistics["rating_ordinal"]["question"], "Q4");
        QCOMPARE(statistics["rating_ordinal"], statistics["rating_ordinal_by_question"]["Q4"]);
        QCOMPARE(statistics["rating_ordinal_by_question"].size(), std::size_t(3));
        const Json& one = statistics["rating_ordinal_by_question"]["Q2"];
        QVERIFY2(one["logLik"].is_number(), one.dump().c_str());
        QCOMPARE(one["formula"], "rounded~condition+(1|participant)+(1|fabric)");
        QVERIFY(one["fixef"].contains("conditionb") && one["se"]["conditionc"].is_number());
        QCOMPARE(one["levels"].size(), one["thresholds"].size() + 1);
        QVERIFY(one["levels"][0].is_number_integer());
        const auto tables = reports::reportTables(analysis);
        const reports::Table* table = ordinalTable(tables);
        QVERIFY(table != nullptr);
        QCOMPARE(table->rows.size(), std::size_t(3 * (2 + 2)));  // two conditions and two groups a question
        // The odds ratio is the exponential of the effect, and the interval holds it.
        const double ratio = std::stod(table->rows[0][4].csv);
        QVERIFY(std::fabs(ratio - std::exp(one["fixef"]["conditionb"].get<double>())) < 1e-9);
        QVERIFY(std::stod(table->rows[0][5].csv) < ratio && ratio < std::stod(table->rows[0][6].csv));
    }

    void aScaleUpToOneHundredHasTens()
    {
        const auto analysis = reports::analyse(
            rating(0, 100, [](int p, int f, int c, int q) { return 100 * share(p, f, c, q) - (p > 0 ? 0.1 : 0); }));
        const Json one = reports::statisticsJson(analysis)["rating_ordinal"];
        QCOMPARE(one["rounding"], "to multiples of 10, halves up");
        for (const Json& level : one["levels"]) QCOMPARE(level.get<int>() % 10, 0);
        QVERIFY(one["thresholds"].contains("10|20"));
    }

    void quickReportsLeaveItOut()
    {
        const auto analysis = reports::analyse(rating(0, 10, [](int p, int f, int c, int q) { return 10 * share(p, f, c, q); }),
                                               {reports::Depth::Quick, {}});
        const Json one = reports::statisticsJson(analysis)["rating_ordinal"];
        QVERIFY(one["logLik"].is_null());
        QCOMPARE(one["why"]["logLik"], "left out by --quick");
        QVERIFY(ordinalTable(reports::reportTables(analysis)) == nullptr);
    }

    void constantRatingsSayWhy()
    {
        const auto analysis = reports::analyse(rating(0, 10, [](int, int, int, int) { return 10.0; }));
        const Json one = reports::statisticsJson(analysis)["rating_ordinal"];
        QCOMPARE(one["why"]["logLik"], "every rating is 10");
        const auto tables = reports::reportTables(analysis);
        QVERIFY(ordinalTable(tables) != nullptr);
        QCOMPARE(ordinalTable(tables)->rows.size(), std::size_t(3));
    }

    void aConditionAtTheTopIsNamed()
    {
        const auto analysis =
            reports::analyse(rating(0, 10, [](int p, int f, int c, int q) { return c == 1 ? 10.0 : 10 * share(p, f, c, q); }));
        const Json one = reports::statisticsJson(analysis)["rating_ordinal"];
        QVERIFY(one["logLik"].is_number() && one["fixef"]["conditionc"].is_number());
        QVERIFY(one["fixef"]["conditionb"].is_null());
        QVERIFY(one["messages"].dump().find("b (always 10)") != std::string::npos);
    }

    void aQuestionOfThisNameIsDisplaced()
    {
        reports::StudyData data = rating(0, 10, [](int p, int f, int c, int q) { return 10 * share(p, f, c, q); });
        data.questions.back().id = "rating_ordinal";
        for (reports::StudyResponse& response : data.responses)
            if (response.question == "Q4") response.question = "rating_ordinal";
        const Json statistics = reports::statisticsJson(reports::analyse(data));
        QVERIFY(statistics["rating_ordinal"].contains("thresholds"));
        QVERIFY(statistics["questions"]["rating_ordinal"].contains("rm_anova"));
    }
};

QTEST_GUILESS_MAIN(OrdinalRatingsTest)
#include "ordinal_ratings_test.moc"
