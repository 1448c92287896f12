// Binomial tests and intervals, d' and McNemar's test against R and by hand.
#include <QTest>
#include <cmath>
#include <numbers>

#include "stats/tests/binomial.h"
#include "stats/tests/forced_choice.h"
#include "stats/tests/mcnemar.h"
#include "tests/stats/exact_numbers.h"
#include "tests/stats/stream.h"

namespace {

/// Probability of a correct choice among three at d': integral of phi(x - d') Phi(x)^2 by the trapezoidal rule.
double correctOfThree(double dPrime)
{
    double sum = 0;
    for (double x = -10; x <= 10; x += 0.125)
        sum += std::exp(-x * x / 2) * std::pow(std::erfc(-(x + dPrime) / std::numbers::sqrt2) / 2, 2);
    return sum * 0.125 / std::sqrt(2 * std::numbers::pi);
}

}  // namespace

class CountsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // R --slave -e 'print(binom.test(1,1000,1/3)$p.value,digits=15);print(binom.test(40,49)$p.value,digits=15)'
    //   7.32133529345336e-174  9.26354640995444e-06
    void twoSidedTailsAgreeWithR()
    {
        QVERIFY(near(*stats::binomialTest(1, 1000, 1.0 / 3).pTwoSided, 7.32133529345336e-174, 1e-11));
        QVERIFY(near(*stats::binomialTest(40, 49, 0.5).pTwoSided, 9.26354640995444e-06, 1e-13));
        QCOMPARE(*stats::binomialTest(5, 10, 0.5).pTwoSided, 1.0);
    }

    // All of n correct at chance 1/3: p = 3^-n.
    void tailsBelowTheSmallestDouble()
    {
        const auto all = stats::binomialTest(2000, 2000, 1.0 / 3);
        QCOMPARE(*all.pGreater, 0.0);
        QVERIFY(near(*all.logPGreater, -2000 * std::log(3.0), 1e-13));
        QVERIFY(near(*all.logPTwoSided, -2000 * std::log(3.0), 1e-13));
        QVERIFY(near(*all.logPMidGreater, -2000 * std::log(3.0) - std::numbers::ln2, 1e-13));
        // At least one of 200: 1 - (2/3)^200, whose logarithm is -(2/3)^200.
        QVERIFY(near(*stats::binomialTest(1, 200, 1.0 / 3).logPGreater, -std::exp(200 * std::log(2.0 / 3)), 1e-11));
    }

    void billionsOfTrialsTakeNoTime()
    {
        const auto test = stats::binomialTest(1000000000, 3000000000, 1.0 / 3);
        QVERIFY(*test.pTwoSided > 0.99 && *test.clopperPearson.low < 1.0 / 3 && *test.clopperPearson.high > 1.0 / 3);
    }

    void sensitivityAtItsEnds()
    {
        const auto below = stats::forcedChoice(20, 70, 3);
        QCOMPARE(*below.dPrime, 0.0);
        QCOMPARE(*below.discriminators, 0.0);
        QVERIFY(!below.seDPrime.exists());
        const auto atChance = stats::forcedChoice(23, 69, 3);  // no double is 1/3
        QVERIFY(*atChance.dPrime == 0.0 && atChance.seDPrime.exists());
        const auto perfect = stats::forcedChoice(70, 70, 3);
        QVERIFY(std::isinf(*perfect.dPrime) && !perfect.seDPrime.why().empty());
        for (const auto& refused : {stats::forcedChoice(0, 0, 3), stats::forcedChoice(4, 3, 3), stats::forcedChoice(-1, 3, 3),
                                    stats::forcedChoice(1, 3, 1)})
            QVERIFY(!refused.why.empty() && !refused.dPrime.exists());
    }

    // The inverse of Hacker and Ratcliff's (1979) table: m = 3, 60 % correct, d' = 0.89; m = 2: sqrt(2) times the normal
    // quantile.
    void sensitivityOfAProportion()
    {
        QVERIFY(std::fabs(*stats::dPrimeAt(0.60, 3) - 0.89) < 0.005);
        // R --slave -e 'print(sqrt(2) * qnorm(0.8), digits = 16)'
        QVERIFY(near(*stats::dPrimeAt(0.8, 2), 1.19023216289999, 1e-13));
        QVERIFY(near(*stats::dPrimeAt(27.0 / 70, 3), *stats::forcedChoice(27, 70, 3).dPrime, 1e-13));
        QCOMPARE(*stats::dPrimeAt(1.0 / 3, 3), 0.0);
        QCOMPARE(*stats::dPrimeAt(0, 3), 0.0);
        QVERIFY(std::isinf(*stats::dPrimeAt(1, 3)));
        double last = 0;
        for (int i = 34; i < 100; ++i) {
            const double dPrime = *stats::dPrimeAt(i / 100.0, 3);
            QVERIFY(dPrime > last && std::fabs(correctOfThree(dPrime) - i / 100.0) < 1e-12);
            last = dPrime;
        }
        for (const stats::Value& refused :
             {stats::dPrimeAt(1.01, 3), stats::dPrimeAt(-0.1, 3), stats::dPrimeAt(NAN, 3), stats::dPrimeAt(0.5, 1)})
            QVERIFY(!refused.exists() && !refused.why().empty());
    }

    // R --slave -e 'mcnemar.test(matrix(c(10,9,40,20),2))': 18.3673469387755, p = 1.8215297148968e-05;
    // exact: binom.test(40, 49)
    void changedPairsAgreeWithR()
    {
        const auto test = stats::mcnemarTest(40, 9);
        QVERIFY(near(*test.chiSquaredCorrected, 18.3673469387755, 1e-14));
        QVERIFY(near(*test.pChiSquaredCorrected, 1.8215297148968e-05, 1e-12));
        QVERIFY(near(*test.pExact, 9.26354640995444e-06, 1e-13));
        // 31 of 32 in one direction: 2 (1 + 32)/2^32; mid-p: 2 (1 + 16)/2^32
        QVERIFY(near(*stats::mcnemarTest(31, 1).pExact, 66 / 4294967296.0, 1e-13));
        QVERIFY(near(*stats::mcnemarTest(1, 31).pMid, 34 / 4294967296.0, 1e-13));
        QCOMPARE(*stats::mcnemarTest(7, 7).pExact, 1.0);
        QVERIFY(near(*stats::mcnemarTest(0, 3000).logPExact, -2999 * std::numbers::ln2, 1e-13));
    }

    void withoutChangeOnlyTheExactPExists()
    {
        const auto test = stats::mcnemarTest(0, 0);
        QCOMPARE(*test.pExact, 1.0);
        QCOMPARE(test.chiSquared.why(), std::string("no pair changed"));
        QVERIFY(!stats::mcnemarTest(-1, 2).why.empty());
    }

    // Rscript tests/stats/reference/counts.R
    void binomialTestsAsInR_data()
    {
        QTest::addColumn<stats::BinomialTest>("test");
        QTest::addColumn<std::vector<double>>("expected");
        QTest::newRow("27 of 70") << stats::binomialTest(27, 70, 1.0 / 3)
                                  << std::vector<double>{0.209625558305277, 0.854359350755117, 0.375333948414112,
                                                         0.17763310377508,  0.271720045069842, 0.509700574295499,
                                                         0.280476913015389, 0.502842644106958};
        QTest::newRow("15 of 70, 99 %") << stats::binomialTest(15, 70, 1.0 / 3, 0.99)
                                        << std::vector<double>{0.989715128760754, 0.020669396439507, 0.0416046094100225,
                                                               0.984522866160623, 0.103976840012189, 0.364866536258033,
                                                               0.115779408052599, 0.362265167276456};
        QTest::newRow("3 of 7, 90 %")
            << stats::binomialTest(3, 7, 0.5, 0.9)
            << std::vector<double>{
                   0.7734375, 0.5, 1.0, 0.63671875, 0.128756392804243, 0.774678415967552, 0.186443190363956, 0.710522908986407};
    }

    void binomialTestsAsInR()
    {
        QFETCH(stats::BinomialTest, test);
        QFETCH(std::vector<double>, expected);
        compareNumbers({{"p greater", test.pGreater, expected[0]},
                        {"log p greater", test.logPGreater, std::log(expected[0])},
                        {"p less", test.pLess, expected[1]},
                        {"p two-sided", test.pTwoSided, expected[2]},
                        {"log p two-sided", test.logPTwoSided, std::log(expected[2])},
                        {"mid p", test.pMidGreater, expected[3]},
                        {"log mid p", test.logPMidGreater, std::log(expected[3])},
                        {"Clopper-Pearson low", test.clopperPearson.low, expected[4]},
                        {"Clopper-Pearson high", test.clopperPearson.high, expected[5]},
                        {"Wilson low", test.wilson.low, expected[6]},
                        {"Wilson high", test.wilson.high, expected[7]}});
    }

    // No success or only successes: one end is exactly 0 or 1, the other (1 - confidence)/2 to the power 1/n, or
    // z^2/(n + z^2).
    void intervalsAtTheirEnds()
    {
        const auto none = stats::binomialTest(0, 12, 0.25);
        const auto all = stats::binomialTest(12, 12, 0.25);
        const double z2 = 3.8414588206941285;  // R: qchisq(.95, 1)
        compareNumbers({{"none, greater", none.pGreater, 1},
                        {"none, less", none.pLess, std::pow(0.75, 12)},
                        {"none, estimate", none.estimate, 0},
                        {"none, exact high", none.clopperPearson.high, 1 - std::pow(0.025, 1.0 / 12)},
                        {"none, Wilson high", none.wilson.high, z2 / (12 + z2)},
                        {"all, greater", all.pGreater, std::pow(0.25, 12)},
                        {"all, less", all.pLess, 1},
                        {"all, estimate", all.estimate, 1},
                        {"all, mid", all.pMidGreater, std::pow(0.25, 12) / 2},
                        {"all, exact low", all.clopperPearson.low, std::pow(0.025, 1.0 / 12)},
                        {"all, Wilson low", all.wilson.low, 12 / (12 + z2)}});
        QVERIFY(*none.wilson.low == 0 && *none.clopperPearson.low == 0 && *all.wilson.high == 1 && *all.clopperPearson.high == 1);
        compareReasons({{"chance 1", stats::binomialTest(1, 2, 1).pGreater, "between 0 and 1"},
                        {"chance 0", stats::binomialTest(1, 2, 0).wilson.low, "between 0 and 1"},
                        {"trials", stats::wilsonInterval(1, 0).low, "no trials"},
                        {"successes", stats::clopperPearsonInterval(3, 2).high, "more successes"},
                        {"negative", stats::clopperPearsonInterval(-3, 2).high, "negative"}});
    }

    // Rscript tests/stats/reference/counts.R
    void mcNemarAsInR()
    {
        for (const auto& test : {stats::mcnemarTest(12, 5), stats::mcnemarTest(5, 12)})
            compareNumbers({{"chi-squared", test.chiSquared, 2.88235294117647},
                            {"its p", test.pChiSquared, 0.0895550744136431},
                            {"corrected chi-squared", test.chiSquaredCorrected, 2.11764705882353},
                            {"its p", test.pChiSquaredCorrected, 0.145610095396868},
                            {"exact p", test.pExact, 0.143463134765625},
                            {"its logarithm", test.logPExact, std::log(0.143463134765625)},
                            {"mid p", test.pMid, 0.0962524414062501},
                            {"its logarithm", test.logPMid, std::log(0.0962524414062501)}});
        QCOMPARE(stats::mcnemarTest(12, 5).b, 12LL);
        QCOMPARE(stats::mcnemarTest(12, 5).c, 5LL);
        // With b = c, |b - c| - 1 is negative and counts as 0.
        compareNumbers({{"corrected chi-squared of equals", stats::mcnemarTest(4, 4).chiSquaredCorrected, 0},
                        {"mid p of equals", stats::mcnemarTest(4, 4).pMid, 1}});
    }

    // Rscript tests/stats/reference/counts.R
    void twoSidedTailsOfManyKinds()
    {
        compareNumbers({{"7 of 20 at 0.2", stats::binomialTest(7, 20, 0.2).pTwoSided, 0.0982217286134687},
                        {"0 of 10 at 0.3", stats::binomialTest(0, 10, 0.3).pTwoSided, 0.0388396033},
                        {"50 of 100 at 0.5", stats::binomialTest(50, 100, 0.5).pTwoSided, 1.0},
                        {"10 of 30 at 0.5", stats::binomialTest(10, 30, 0.5).pTwoSided, 0.0987371467053889},
                        {"9 of 12 at 0.6", stats::binomialTest(9, 12, 0.6).pTwoSided, 0.383549575168},
                        {"20 of 21 at 0.9", stats::binomialTest(20, 21, 0.9).pTwoSided, 0.716321139288672}});
    }
};

QTEST_GUILESS_MAIN(CountsTest)
#include "counts_test.moc"
