// Properties that hold for all data, extreme data, descriptions, and measures of speed and accuracy.
#include <QTest>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/descriptive.h"
#include "stats/kernels/distributions.h"
#include "stats/tests/binomial.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "stats/tests/speed_accuracy.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/wilcoxon.h"
#include "tests/stats/exact_numbers.h"
#include "tests/stats/stream.h"

class StatisticsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void powersOfTwoChangeNoBitOfT_data()
    {
        QTest::addColumn<int>("exponent");
        for (const int exponent : {-900, -300, -7, 3, 300, 900}) QTest::addRow("2^%d", exponent) << exponent;
    }

    void powersOfTwoChangeNoBitOfT()
    {
        QFETCH(int, exponent);
        Stream stream(3);
        auto x = stream.ratings(25, 6);
        auto y = stream.ratings(25, 5.5);
        const auto plain = stats::pairedTTest(x, y);
        const auto welch = stats::welchTTest(x, y);
        for (auto* sample : {&x, &y})
            for (double& value : *sample) value = std::ldexp(value, exponent);
        const auto scaled = stats::pairedTTest(x, y);
        // QCOMPARE would allow differences in the last bits.
        QVERIFY(*scaled.t == *plain.t);
        QVERIFY(*scaled.p == *plain.p);
        QVERIFY(*stats::welchTTest(x, y).t == *welch.t);
        QVERIFY(*scaled.estimate == std::ldexp(*plain.estimate, exponent));
    }

    void equivalenceMirrorsWhenTheSamplesAreSwapped()
    {
        Stream stream(5);
        const auto x = stream.ratings(12, 6);
        const auto y = stream.ratings(12, 6.1);
        const auto one = stats::equivalenceTest(stats::TKind::Paired, x, y, {-0.3, 0.8, 0.05});
        const auto other = stats::equivalenceTest(stats::TKind::Paired, y, x, {-0.8, 0.3, 0.05});
        QCOMPARE(*one.pLower, *other.pUpper);
        QCOMPARE(*one.pUpper, *other.pLower);
        QCOMPARE(*one.p, *other.p);
        QCOMPARE(one.verdict(), other.verdict());
    }

    void intervalLiesInsideTheBoundsExactlyWhenEquivalent()
    {
        int equivalent = 0;
        for (std::uint64_t seed = 0; seed < 400; ++seed) {
            Stream stream(seed);
            const auto x = stream.ratings(10, 6);
            auto y = x;
            for (double& value : y) value += stream.next() * 2.2 - 1.1;
            const auto test = stats::equivalenceTest(stats::TKind::Paired, x, y);
            const bool inside = *test.ci.low > -0.5 && *test.ci.high < 0.5;
            QCOMPARE(inside, test.equivalent);
            equivalent += test.equivalent ? 1 : 0;
        }
        QVERIFY(equivalent > 50 && equivalent < 350);  // both outcomes occurred
    }

    void correctedIsNeverBelowRawAndKeepsTheOrder()
    {
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            Stream stream(seed);
            std::vector<stats::Value> p;
            for (int i = 0; i < 36; ++i) p.emplace_back(std::pow(stream.next(), 3));
            for (const auto method : {stats::Adjustment::Holm, stats::Adjustment::BenjaminiHochberg}) {
                const auto corrected = stats::adjusted(p, method);
                for (std::size_t i = 0; i < p.size(); ++i)
                    for (std::size_t j = 0; j < p.size(); ++j) {
                        QVERIFY(*corrected[i] >= *p[i] && *corrected[i] <= 1);
                        if (*p[i] <= *p[j]) QVERIFY(*corrected[i] <= *corrected[j]);
                    }
            }
        }
    }

    void twoConditionsMakeFEqualToTSquared()
    {
        Stream stream(11);
        const auto x = stream.ratings(9, 6);
        const auto y = stream.ratings(9, 5);
        std::vector<std::vector<double>> rows;
        for (std::size_t i = 0; i < x.size(); ++i) rows.push_back({x[i], y[i]});
        const auto anova = stats::repeatedMeasuresAnova(stats::blockTableOf(rows).table);
        const auto t = stats::pairedTTest(x, y);
        QVERIFY(near(*anova.f, *t.t * *t.t, 1e-13));
        QVERIFY(near(*anova.p, *t.p, 1e-12));
        QCOMPARE(*anova.epsilonGg, 1.0);
    }

    void orderOfTheBlocksDoesNotMatterToRanks()
    {
        Stream stream(13);
        std::vector<std::vector<double>> rows;
        for (int i = 0; i < 10; ++i) rows.push_back(stream.ratings(5, 5));
        const auto before = stats::friedmanTest(stats::blockTableOf(rows).table);
        std::reverse(rows.begin(), rows.end());
        const auto after = stats::friedmanTest(stats::blockTableOf(rows).table);
        QCOMPARE(*after.q, *before.q);
    }

    /// R 4.2, t.test(x, y, paired = TRUE): "data are essentially constant". Before, p was as small as 1e-77.
    void meansWithEqualDifferencesAreNoEvidence()
    {
        std::mt19937 draw(1);
        for (int study = 0; study < 300; ++study) {
            const int ratings = 1 + static_cast<int>(draw() % 12);
            std::vector<double> x, y;
            for (int person = 0; person < 10; ++person) {
                double sumX = 0, sumY = 0;
                for (int i = 0; i < ratings; ++i) {
                    const int tenths = 3 + static_cast<int>(draw() % 97);
                    sumX += tenths / 10.0;
                    sumY += (tenths - 3) / 10.0;
                }
                x.push_back(sumX / ratings);
                y.push_back(sumY / ratings);
            }
            QCOMPARE(stats::pairedTTest(x, y).why, std::string("no variation: all differences are equal"));
        }
        QVERIFY(stats::oneSampleTTest(std::vector<double>{0.1 + 0.2, 0.3, 0.7 - 0.4}).why.starts_with("no variation"));
        QVERIFY(stats::pairedTTest(std::vector<double>{5.1, 6.2, 7.4}, std::vector<double>{4.8, 5.9, 7.0}).why.empty());
    }

    void undefinedTestsSayWhy_data()
    {
        QTest::addColumn<std::vector<double>>("x");
        QTest::addColumn<std::vector<double>>("y");
        QTest::addColumn<QString>("why");
        using V = std::vector<double>;
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const double inf = std::numeric_limits<double>::infinity();
        QTest::newRow("nothing") << V{} << V{} << "no values";
        QTest::newRow("one pair") << V{1} << V{2} << "at least 2";
        QTest::newRow("identical") << V{1, 2, 3} << V{1, 2, 3} << "all differences are equal";
        // 1.1-1.0 and 4.1-4.0 differ in their binary digits; scipy 1.10 answers p = 3e-45 here.
        QTest::newRow("constant but for rounding") << V{1.1, 2.1, 3.1, 4.1} << V{1, 2, 3, 4} << "all differences are equal";
        QTest::newRow("not pairs") << V{1, 2, 3} << V{1, 2} << "not pairs";
        QTest::newRow("NaN") << V{1, nan, 3} << V{1, 2, 2} << "value 2 of x is not a number";
        QTest::newRow("infinite") << V{1, 2, 3} << V{1, 2, inf} << "value 3 of y is infinite";
    }

    void undefinedTestsSayWhy()
    {
        QFETCH(std::vector<double>, x);
        QFETCH(std::vector<double>, y);
        QFETCH(QString, why);
        const auto t = stats::pairedTTest(x, y);
        QVERIFY2(QString::fromStdString(t.why).contains(why), t.why.c_str());
        QVERIFY(!t.t.exists() && !t.p.exists() && !t.ci.low.exists());
        const auto tost = stats::equivalenceTest(stats::TKind::Paired, x, y);
        QVERIFY(!tost.p.exists() && !tost.equivalent);
        QVERIFY(QString::fromStdString(tost.verdict()).startsWith("undefined: "));
    }

    void descriptionOfNothingOneAndConstant()
    {
        const auto none = stats::describe(std::vector<double>{});
        QCOMPARE(none.n, std::size_t{0});
        QVERIFY(!none.mean.exists() && !none.median.exists() && !none.mean.why().empty());
        const auto one = stats::describe(std::vector<double>{3.5, std::numeric_limits<double>::quiet_NaN()});
        QCOMPARE(one.n, std::size_t{1});
        QCOMPARE(one.missing, std::size_t{1});
        QCOMPARE(*one.mean, 3.5);
        QVERIFY(!one.sd.exists() && !one.ci95.low.exists());
        const auto constant = stats::describe(std::vector<double>(10, 0.04));
        QCOMPARE(*constant.sd, 0.0);
        QVERIFY(!constant.autocorrelationLag1.exists());
        QVERIFY(!constant.ci95.low.exists() && !constant.ci95.high.exists());
        QCOMPARE(constant.ci95.low.why(), std::string("no variation: all values are equal"));
        const auto rounded = stats::describe(std::vector<double>{37.0 / 6, std::nextafter(37.0 / 6, 7), 37.0 / 6});
        QVERIFY(!rounded.ci95.low.exists());
        QVERIFY(stats::describe(std::vector<double>{1e15 + 1, 1e15 + 2}).ci95.low.exists());
        const auto infinite = stats::describe(std::vector<double>{1, std::numeric_limits<double>::infinity()});
        QVERIFY(!infinite.mean.exists());
    }

    void extremeScalesKeepTheirDigits()
    {
        // Mean and SD of {1, 2} are 1.5 and sqrt(1/2) at every power of two.
        for (const int exponent : {-1070, -600, 600, 1021}) {
            const std::vector<double> x{std::ldexp(1, exponent), std::ldexp(2, exponent)};
            const auto description = stats::describe(x);
            QCOMPARE(*description.mean, std::ldexp(1.5, exponent));
            QCOMPARE(*description.sd, std::ldexp(std::sqrt(0.5), exponent));
        }
        // The sum of these is beyond 1e308.
        QVERIFY(near(*stats::describe(std::vector<double>{1e308, 1.2e308, 1.5e308}).mean, 1.2333333333333333e308, 1e-15));
        // 1e16 + {2, 4, 6, 10}: their mean, 1e16 + 5.5, is no double; the variance is 35/3.
        QVERIFY(near(*stats::describe(std::vector<double>{1e16 + 2, 1e16 + 4, 1e16 + 6, 1e16 + 10}).variance, 35.0 / 3, 1e-15));
        // The variance of these is 2.5 exactly; 1e15 + 1 ... 1e15 + 5.
        QCOMPARE(*stats::describe(std::vector<double>{1e15 + 1, 1e15 + 2, 1e15 + 3, 1e15 + 4, 1e15 + 5}).variance, 2.5);
    }

    // /usr/bin/python3 -c "import numpy as np; x=[2,4,4,5,7,9]; print(np.quantile(x,[.25,.5,.75]))"
    //   [4.   4.5  6.5]
    void quartilesAreOfTypeSeven()
    {
        const auto description = stats::describe(std::vector<double>{9, 4, 2, 5, 4, 7});
        QCOMPARE(*description.q1, 4.0);
        QCOMPARE(*description.median, 4.5);
        QCOMPARE(*description.q3, 6.5);
    }

    void logarithmOfPGoesOnBelowTheSmallestDouble()
    {
        // With 2 degrees of freedom p = 1 - t/sqrt(2 + t^2), which is 1/t^2 for large t.
        const auto two = stats::studentTwoSided(1e200, 2);
        QCOMPARE(two.p, 0.0);
        QVERIFY(near(two.logP, -400 * std::log(10.0), 1e-13));
        // The series of the incomplete beta function I_x(99/2, 1/2), x = 99/(99 + t^2), in 60 digits with Python's
        // decimal; R: log(2) + pt(-100136.1547, 99, log.p = TRUE)
        const auto tail = stats::studentTwoSided(100136.1547, 99);
        QCOMPARE(tail.p, 0.0);
        QVERIFY2(near(tail.logP, -914.981766894172459, 1e-13), qPrintable(QString::number(tail.logP, 'g', 17)));
        // Continuous where the direct and the logarithmic computation meet.
        const double above = stats::studentTwoSided(80, 300).logP;
        const double below = stats::studentTwoSided(81, 300).logP;
        QVERIFY(below < above && above - below < 4);
    }

    void decimalsOfEqualSumHaveEqualMeans()
    {
        // In binary 0.1+0.2+0.3 and 0.3+0.2+0.1 differ; as tenths both are 6.
        QCOMPARE(*stats::meanOf(std::vector<double>{0.1, 0.2, 0.3}), *stats::meanOf(std::vector<double>{0.3, 0.2, 0.1}));
        QCOMPARE(*stats::meanOf(std::vector<double>{0.1, 0.2, 0.3}), 0.2);
        QCOMPARE(*stats::meanOf(std::vector<double>(70, 5.1)), 5.1);
        QCOMPARE(stats::decimalGridOf(std::vector<double>{5.4, 3.0, 0.25})->places, 2);
        QVERIFY(!stats::decimalGridOf(std::vector<double>{1.0 / 3}));
        QVERIFY(!stats::meanOf(std::vector<double>{}).exists());
    }

    void tiesOfDecimalsAreTies()
    {
        // All four differences have the size 0.1; as doubles they have three sizes, which gives p = 1.
        const std::vector<double> x{0.3, 0.5, 0.9, 0.7};
        const std::vector<double> y{0.2, 0.4, 0.8, 0.8};
        QCOMPARE(*stats::wilcoxonSignedRank(x, y).pExact, 0.625);
        const auto binary = stats::wilcoxonSignedRank(x, y, {.arithmetic = stats::Arithmetic::Double});
        QCOMPARE(*binary.pExact, 1.0);
    }

    void equalProportionsHaveNoBalancedScore()
    {
        const std::vector<double> rt{356.8, 325.1, 370.6, 362.8, 348.5, 640.3, 634.2, 650.7, 584.5, 610.0};
        QVERIFY(!stats::balancedIntegrationScores(std::vector<double>(10, 0.7), rt)[0].exists());
    }

    void informationIsNothingAtChanceAndWholeWhenPerfect()
    {
        QCOMPARE(*stats::bitsPerChoice(1.0 / 3, 3), 0.0);
        QCOMPARE(*stats::bitsPerChoice(0.0, 3), 0.0);
        QCOMPARE(*stats::bitsPerChoice(1, 4), 2.0);
        QCOMPARE(*stats::bitsPerSecond(1, 4, 8), 0.25);
        QVERIFY(!stats::bitsPerSecond(1, 4, 0).exists());
        // log2 3 + .7 log2 .7 + .3 log2 .15
        QVERIFY(near(*stats::bitsPerChoice(0.7, 3), std::log2(3) + 0.7 * std::log2(0.7) + 0.3 * std::log2(0.15), 1e-14));
        const auto times = stats::responseTimes(std::vector<double>{2, 8, 4});
        QCOMPARE(*times.median, 4.0);
        QVERIFY(near(*times.geometricMean, 4, 1e-15));
        QVERIFY(!stats::responseTimes(std::vector<double>{2, 0}).logMean.exists());
    }

    void countsOutsideTheirDomainAreRefused()
    {
        QVERIFY(!stats::binomialTest(0, 0, 1.0 / 3).pGreater.exists());
        QVERIFY(!stats::binomialTest(5, 3, 1.0 / 3).why.empty());
        QVERIFY(!stats::wilsonInterval(-1, 3).low.exists());
        QCOMPARE(*stats::wilsonInterval(0, 7).low, 0.0);
        QCOMPARE(*stats::clopperPearsonInterval(7, 7).high, 1.0);
    }

    // /usr/bin/python3 tests/stats/reference/signals.py
    void speedAndAccuracyAsInScipy()
    {
        const std::vector<double> rt{356.8, 325.1, 370.6, 362.8, 348.5, 640.3, 634.2, 650.7, 584.5, 610.0};
        const std::vector<double> pc{.71, .73, .67, .73, .72, .97, .99, .99, .97, .97};
        const auto scores = stats::balancedIntegrationScores(pc, rt);
        compareNumbers({{"score 0", scores[0], -0.0469779388804572, 1e-11},
                        {"score 1", scores[1], 0.333410508220449, 1e-11},
                        {"score 2", scores[2], -0.445917205353704, 1e-11},
                        {"score 3", scores[3], 0.0583847306928901, 1e-11},
                        {"score 4", scores[4], 0.0881381780298618, 1e-11},
                        {"score 5", scores[5], -0.176409050923322, 1e-11},
                        {"score 6", scores[6], 0.0172244915434858, 1e-11},
                        {"score 7", scores[7], -0.103144880583961, 1e-11},
                        {"score 8", scores[8], 0.230658280271315, 1e-11},
                        {"score 9", scores[9], 0.0446328869834431, 1e-11}});
        compareReasons(
            {{"equal times", stats::balancedIntegrationScores(pc, std::vector<double>(10, 1.0))[3], "all times are equal"},
             {"one cell", stats::balancedIntegrationScores(std::vector<double>{0.5}, std::vector<double>{1})[0], "2 cells"},
             {"sizes", stats::balancedIntegrationScores(pc, std::vector<double>{1})[0], "differ in number"}});
        const auto times = stats::responseTimes(std::vector<double>{1.2, 0.8, 3.1, 2.4, 0.9, 1.7});
        QCOMPARE(times.n, std::size_t{6});
        compareNumbers({{"median", times.median, 1.45},
                        {"mean", times.mean, 1.68333333333333},
                        {"mean logarithm", times.logMean, 0.398552764954848},
                        {"geometric mean", times.geometricMean, 1.48966723820963}});
        compareNumbers({{"bits of 3", stats::bitsPerChoice(0.7, 3), 0.403671601490463},
                        {"bits of 2", stats::bitsPerChoice(0.9, 2), 0.531004406410719},
                        {"bits just above chance", stats::bitsPerChoice(0.26, 4), 0.000381376973726422, 1e-9},
                        {"bits below chance", stats::bitsPerChoice(0.24, 4), 0},
                        {"bits a second", stats::bitsPerSecond(0.7, 3, 1.6), 0.403671601490463 / 1.6}});
        compareReasons({{"one alternative", stats::bitsPerChoice(0.5, 1), "at least 2 alternatives"},
                        {"proportion", stats::bitsPerChoice(1.1, 3), "between 0 and 1"},
                        {"seconds", stats::bitsPerSecond(0.7, 3, -1), "not positive"}});
    }

    // R: x <- c(3.2, NA, 1.5, 4.4, 2.1, 3.9, 0.7, 2.8); y <- x[!is.na(x)]; t.test(y)$conf.int; sd(y); var(y);
    //   quantile(y, c(.25, .5, .75)); d <- y - mean(y); sum(d[-7] * d[-1])/sum(d^2)
    void descriptionsAsInR()
    {
        const std::vector<double> x{3.2, std::nan(""), 1.5, 4.4, 2.1, 3.9, 0.7, 2.8};
        const auto all = stats::describe(x);
        QCOMPARE(all.n, std::size_t{7});
        QCOMPARE(all.missing, std::size_t{1});
        compareNumbers({{"mean", all.mean, 2.65714285714286},
                        {"sd", all.sd, 1.31511361088075},
                        {"variance", all.variance, 1.72952380952381},
                        {"lag 1", all.autocorrelationLag1, -0.676526117054751},
                        {"q1", all.q1, 1.8},
                        {"median", all.median, 2.8},
                        {"q3", all.q3, 3.55},
                        {"min", all.min, 0.7},
                        {"max", all.max, 4.4},
                        {"low", all.ci95.low, 1.44086562556461},
                        {"high", all.ci95.high, 3.87342008872111}});
        const std::vector<double> four{1, 2, 4, 8};
        compareNumbers({{"10 %", stats::quantile(four, 0.1), 1.3},
                        {"90 %", stats::quantile(four, 0.9), 6.8},
                        {"0 %", stats::quantile(four, 0), 1},
                        {"100 %", stats::quantile(four, 1), 8},
                        {"median", stats::median(std::vector<double>{8, 1, 4, 2}), 3}});
        compareReasons({{"median of nothing", stats::median({}), "no values"},
                        {"sd of one", stats::describe(std::vector<double>{2}).sd, "at least 2 values"},
                        {"mean of nothing", stats::describe({}).mean, "no values"},
                        {"lag of a constant", stats::describe(std::vector<double>{2, 2}).autocorrelationLag1, "equal"}});
        compareNumbers({{"mean of one", stats::describe(std::vector<double>{2}).mean, 2},
                        {"sd of a constant", stats::describe(std::vector<double>{2, 2}).sd, 0}});
    }
};

QTEST_GUILESS_MAIN(StatisticsTest)
#include "statistics_test.moc"
