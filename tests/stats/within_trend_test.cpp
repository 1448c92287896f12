// Slopes within participants against R's lm and t.test.
#include "stats/claims/within_trend.h"

#include <QTest>
#include <cmath>

using stats::TrendRow;

namespace {

/// Three conditions, four fabrics, 12 trials of participant p.
std::vector<TrendRow> rowsOf(int p)
{
    std::vector<TrendRow> rows;
    for (int c = 0; c < 3; ++c)
        for (int f = 0; f < 4; ++f) {
            const int trial = (7 * (4 * c + f) + 5 * p) % 12 + 1;
            rows.push_back({static_cast<std::size_t>(c), static_cast<std::size_t>(f), static_cast<double>(trial),
                            (31 * p + 17 * c + 23 * f + 5 * trial * trial) % 41 / 4.0});
        }
    return rows;
}

bool isNear(const stats::Value& value, double expected)
{
    return value.exists() && std::fabs(*value - expected) <= 1e-12 * std::max(1.0, std::fabs(expected));
}

}  // namespace

class WithinTrendTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // R: rows <- expand.grid(f = 0:3, c = 0:2, p = 0:4); rows$trial <- (7 * (4 * rows$c + rows$f) + 5 * rows$p) %% 12 + 1
    //    rows$value <- ((31 * rows$p + 17 * rows$c + 23 * rows$f + 5 * rows$trial^2) %% 41) / 4
    //    slope <- function(d) unname(coef(lm(value ~ trial + factor(c) + factor(f), d))["trial"])
    //    slopes <- sapply(split(rows, rows$p), slope); t <- t.test(slopes)
    //    print(slopes, digits = 15); print(c(t$estimate, t$conf.int, t$statistic, t$p.value), digits = 15)
    void slopesAreThoseOfLm()
    {
        std::vector<std::vector<TrendRow>> participants;
        for (int p = 0; p < 5; ++p) participants.push_back(rowsOf(p));
        const stats::WithinTrend trend = stats::withinTrend(participants);
        const std::vector<double> expected{0.441666666666667, -0.40625, -0.14375, 0.10625, 0.441666666666667};
        for (std::size_t p = 0; p < expected.size(); ++p) QVERIFY(isNear(trend.slopes[p], expected[p]));
        QVERIFY(isNear(trend.test.estimate, 0.0879166666666667));
        QVERIFY(isNear(trend.test.ci.low, -0.3718698415873268));
        QVERIFY(isNear(trend.test.ci.high, 0.5477031749206603));
        QVERIFY(isNear(trend.test.t, 0.5308894333566012));
        QVERIFY(isNear(trend.test.p, 0.6236039981939558));
    }

    // R: cut <- rows[!(rows$p == 2 & rows$c == 1 & rows$f < 2), ]; print(slope(cut[cut$p == 2, ]), digits = 15)
    void missingAnswersAreLeftOutAsByLm()
    {
        std::vector<TrendRow> rows = rowsOf(2);
        std::erase_if(rows, [](const TrendRow& row) { return row.condition == 1 && row.fabric < 2; });
        QVERIFY(isNear(stats::adjustedSlope(rows), -0.46969696969697));
    }

    void orderOfTheRowsDoesNotMatter()
    {
        std::vector<TrendRow> rows = rowsOf(3);
        const stats::Value slope = stats::adjustedSlope(rows);
        std::reverse(rows.begin(), rows.end());
        QCOMPARE(*stats::adjustedSlope(rows), *slope);
    }

    void aSlopeIsFoundBesideAnyEffectsOfConditionAndFabric()
    {
        std::vector<TrendRow> rows = rowsOf(1);
        for (TrendRow& row : rows)
            row.value = 0.25 * row.covariate + 100.0 * static_cast<double>(row.condition) -
                        3.7 * static_cast<double>(row.fabric * row.fabric);
        QVERIFY(std::fabs(*stats::adjustedSlope(rows) - 0.25) < 1e-13);
        // No trend at all is a slope of exactly 0, not one of rounding errors.
        for (TrendRow& row : rows) row.value -= 0.25 * row.covariate;
        QCOMPARE(*stats::adjustedSlope(rows), 0.0);
    }

    void undefinedSlopesHaveAReason()
    {
        QCOMPARE(stats::adjustedSlope({}).why(), std::string("too few answers for a slope beside the other effects"));
        std::vector<TrendRow> rows = rowsOf(0);
        for (TrendRow& row : rows) row.covariate = static_cast<double>(row.condition) - 2.0 * static_cast<double>(row.fabric);
        QCOMPARE(stats::adjustedSlope(rows).why(), std::string("it does not vary beside the other effects"));
        rows[3].value = NAN;
        QCOMPARE(stats::adjustedSlope(rows).why(), std::string("a value is not finite"));
        const std::vector<std::vector<TrendRow>> short1{{rowsOf(0)[0]}, {}};
        const stats::WithinTrend trend = stats::withinTrend(short1);
        QCOMPARE(trend.test.why, std::string("too few answers for a slope beside the other effects"));
        QVERIFY(!trend.test.p.exists() && !trend.test.ci.low.exists());
        QVERIFY(!stats::withinTrend({}).test.why.empty());
    }
};

QTEST_GUILESS_MAIN(WithinTrendTest)
#include "within_trend_test.moc"
