// Sign flips, the BCa bootstrap and random draws against programs written a second time.
#include <QTest>
#include <cmath>
#include <numbers>

#include "stats/kernels/draws.h"
#include "stats/tests/bayes_factor.h"
#include "stats/tests/bootstrap.h"
#include "stats/tests/sign_flip.h"
#include "tests/stats/exact_numbers.h"
#include "tests/stats/stream.h"

namespace {

const std::vector<double> tenths{.3, -.1, .5, .5, .2, -.4, .6, .1, .9, -.2};

}  // namespace

class ResamplingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // python3: d=[3,-1,5,5,2,-4,6,1,9,-2]; s=[sum(a*b for a,b in zip(q,d)) for q in product((1,-1),repeat=10)]
    //   sum(abs(v)>=sum(d) for v in s)/1024, sum(v>=sum(d) for v in s)/1024      0.107421875 0.0537109375
    void signFlipsAreThoseOfAllSigns()
    {
        QCOMPARE(*stats::signFlipTest(tenths, {}).p, 0.107421875);
        QCOMPARE(*stats::signFlipTest(tenths, {}, stats::Tail::Greater).p, 0.0537109375);
        // P(S <= s) = 1 - P(S >= s) + P(S = s)
        const double less = *stats::signFlipTest(tenths, {}, stats::Tail::Less).p;
        QVERIFY(less > 1 - 0.0537109375 && less < 1);
    }

    // Thirds lie on no decimal grid; the test then enumerates all signs, with the same result.
    void offTheGridSignsAreEnumerated()
    {
        auto thirds = tenths;
        for (double& x : thirds) x /= 3;
        QCOMPARE(*stats::signFlipTest(thirds, {}).p, 0.107421875);
        QVERIFY(QString::fromStdString(stats::signFlipTest(Stream(1).numbers(40), {}).why).contains("no decimal grid"));
    }

    // Half points and whole points give the same test.
    void stepOfTheScaleDoesNotMatter()
    {
        const std::vector<double> points{1, 2, -1, 3, 3, -2}, halves{.5, 1, -.5, 1.5, 1.5, -1};
        QCOMPARE(*stats::signFlipTest(halves, {}).p, *stats::signFlipTest(points, {}).p);
    }

    // All 70 differences are equal and positive: only two of 2^70 sums are as far from 0.
    void tailOfAllSigns()
    {
        const std::vector<double> x(70, 0.1);
        const auto test = stats::signFlipTest(x, {});
        QVERIFY(near(*test.p, std::ldexp(1, -69), 1e-14));
        QVERIFY(near(*test.logP, -69 * std::numbers::ln2, 1e-14));
        QVERIFY(near(*stats::signFlipTest(x, {}, stats::Tail::Less).p, 1, 1e-15));
    }

    void pairsAndTheirDifferencesAreTheSameTest()
    {
        const std::vector<double> x{5.3, 4.2, 5.8, 7.1, 7.7, 8.2}, y{5.2, 4.6, 5.8, 6.0, 7.0, 8.5};
        const auto paired = stats::signFlipTest(x, y);
        QCOMPARE(paired.nZero, std::size_t{1});
        QCOMPARE(*paired.p, *stats::signFlipTest(std::vector<double>{.1, -.4, 0, 1.1, .7, -.3}, {}).p);
        QVERIFY(near(*paired.meanDifference, 0.2, 1e-14));
    }

    // python3 (scipy 1.10.1): ((x-x.mean())**3).sum()/(6*((x-x.mean())**2).sum()**1.5)    0.06076504249773441
    // stats.bootstrap((x,), np.mean, n_resamples=2000000, method='BCa', random_state=1)   low 2.89 high 5.19
    void bootstrapAgreesWithScipy()
    {
        const std::vector<double> x{2.1, 3.4, 1.9, 5.6, 4.4, 2.2, 7.9, 3.1, 2.8, 4.0};
        const auto many = stats::bcaBootstrapOfMean(x, {.resamples = 1000000});
        QVERIFY(near(*many.acceleration, 0.06076504249773441, 1e-12));
        QVERIFY(std::fabs(*many.ci.low - 2.89) < 0.011 && std::fabs(*many.ci.high - 5.19) < 0.011);
        // SD of the resampled mean: sqrt((n - 1)/n) of the standard error
        QVERIFY(near(*many.standardError, 0.5578888778242491, 0.005));
        const auto few = stats::bcaBootstrapOfMean(x);
        QVERIFY(std::fabs(*few.ci.low - 2.89) < 0.06 && std::fabs(*few.ci.high - 5.19) < 0.12);
    }

    void symmetricSampleHasNoBias()
    {
        const auto result = stats::bcaBootstrapOfMean(std::vector<double>{1, 2, 3, 4, 5}, {.resamples = 200000});
        QVERIFY(std::fabs(*result.acceleration) < 1e-15);
        QVERIFY(std::fabs(*result.bias) < 0.01);  // ties count half; 5 values have many
        QVERIFY(!stats::bcaBootstrapOfMean(std::vector<double>{1, 2}, {.resamples = 0}).why.empty());
        QVERIFY(!stats::bcaBootstrapOfMean(std::vector<double>{1, 2}, {.confidence = 1}).why.empty());
    }

    void bayesFactorsBeyondTheDoubles()
    {
        const auto huge = stats::jzsBayesFactor(1000, 10000);
        QVERIFY(!huge.bf10.exists() && !huge.bf10.decimal().empty() && *huge.logBf10 > 20000);
        QVERIFY(std::isfinite(*stats::jzsBayesFactor(1e200, 3).logBf10));
        QVERIFY(!stats::jzsBayesFactor(2, 1).why.empty() && !stats::jzsBayesFactor(2, 10, 0).why.empty());
    }

    // /usr/bin/python3 tests/stats/reference/resampling.py
    void bootstrapAsWrittenASecondTime_data()
    {
        QTest::addColumn<stats::BcaBootstrap>("result");
        QTest::addColumn<std::vector<double>>("expected");
        QTest::newRow("even, on a grid") << stats::bcaBootstrapOfMean(
                                                std::vector<double>{2.1, 3.4, 1.9, 5.6, 4.4, 2.2, 7.9, 3.1, 2.8, 4.0},
                                                {.resamples = 1000})
                                         << std::vector<double>{0.568847628016501, 0.043880072299401, 0.0607650424977344, 2.88,
                                                                5.26909559394349};
        QTest::newRow("odd, on a grid") << stats::bcaBootstrapOfMean(std::vector<double>{0.3, -0.1, 0.5, 0.5, 0.2, -0.4, 0.6},
                                                                     {.resamples = 777, .confidence = 0.9, .seed = 9})
                                        << std::vector<double>{0.127004539836405, -0.118023666163601, -0.0452624903287265,
                                                               -0.0428571428571429, 0.4};
        QTest::newRow("roots, off the grid")
            << stats::bcaBootstrapOfMean(
                   std::vector<double>{std::sqrt(2.0), std::sqrt(3.0), std::sqrt(5.0), std::sqrt(7.0), std::sqrt(11.0)},
                   {.resamples = 500, .seed = 3})
            << std::vector<double>{0.304581988068742, -0.040116810184968, 0.0208186044451336, 1.72408856115055, 2.86553529793993};
    }

    void bootstrapAsWrittenASecondTime()
    {
        QFETCH(stats::BcaBootstrap, result);
        QFETCH(std::vector<double>, expected);
        QCOMPARE(result.why, std::string());
        compareNumbers({{"standard error", result.standardError, expected[0]},
                        {"bias", result.bias, expected[1]},
                        {"acceleration", result.acceleration, expected[2]},
                        {"low", result.ci.low, expected[3]},
                        {"high", result.ci.high, expected[4]}});
    }

    void drawsAreThoseOfSplitMix64()
    {
        stats::Draws bits(7, 3);
        QCOMPARE(bits.bits(), std::uint64_t{5123015643707495125U});
        QCOMPARE(bits.bits(), std::uint64_t{18109886276499397889U});
        stats::Draws draws(7, 3);
        compareNumbers({{"uniform", draws.uniform(), 0.277719234529245},
                        {"normal", draws.normal(), 0.149049989391599},
                        {"second normal", draws.normal(), -1.30324310121071},
                        {"third normal, SD 2", draws.normal(2), 2 * 0.333899974642037}});
        // The first uniform number of this stream is 0.277719234529245.
        QVERIFY(stats::Draws(7, 3).happens(0.278) && !stats::Draws(7, 3).happens(0.277));
    }

    void bootstrapSaysWhyItHasNoInterval()
    {
        const std::vector<double> two{1, 2};
        compareReasons(
            {{"resamples", stats::bcaBootstrapOfMean(two, {.resamples = 0}).ci.low, "1 to 100000000 resamples"},
             {"resamples", stats::bcaBootstrapOfMean(two, {.resamples = 100000001}).ci.low, "1 to 100000000 resamples"},
             {"confidence", stats::bcaBootstrapOfMean(two, {.confidence = 1}).ci.low, "between 0 and 1"},
             {"no confidence", stats::bcaBootstrapOfMean(two, {.confidence = 0}).ci.low, "between 0 and 1"},
             {"one value", stats::bcaBootstrapOfMean(std::vector<double>{1}).ci.high, "at least 2 values"},
             {"no value", stats::bcaBootstrapOfMean(std::vector<double>{}).ci.high, "no values"},
             {"one resample", stats::bcaBootstrapOfMean(std::vector<double>{1, 7, 9}, {.resamples = 1}).ci.low, "one side"}});
        compareNumbers({{"mean of a constant", stats::bcaBootstrapOfMean(std::vector<double>{0.25, 0.25}).estimate, 0.25}});
    }
};

QTEST_GUILESS_MAIN(ResamplingTest)
#include "resampling_test.moc"
