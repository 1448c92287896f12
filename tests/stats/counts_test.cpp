// Binomial tails, d', McNemar: numbers that come from somewhere else.
#include <QtTest>
#include <cmath>
#include <numbers>

#include "stats/tests/binomial.h"
#include "stats/tests/forced_choice.h"
#include "stats/tests/mcnemar.h"
#include "tests/stats/stream.h"

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

    // python3 (mpmath 1.2.1): d at which quad(lambda x: npdf(x-d)*ncdf(x)**(m-1), [d-9,d,d+9]) is k/n,
    // and sqrt(p*(1-p)/n)/diff(...) there
    void sensitivityAgreesWithItsIntegral_data()
    {
        QTest::addColumn<int>("correct");
        QTest::addColumn<int>("alternatives");
        QTest::addColumn<double>("dPrime");
        QTest::addColumn<double>("se");
        QTest::newRow("27 of 70 among 3") << 27 << 3 << 0.180873436796818 << 0.196374950324;
        QTest::newRow("50 of 70 among 4") << 50 << 4 << 1.54550945856751 << 0.199857412764;
        QTest::newRow("69 of 70 among 2") << 69 << 2 << 3.09620811703755 << 0.552362187392;
    }

    void sensitivityAgreesWithItsIntegral()
    {
        QFETCH(int, correct);
        QFETCH(int, alternatives);
        QFETCH(double, dPrime);
        QFETCH(double, se);
        const auto found = stats::forcedChoice(correct, 70, alternatives);
        QVERIFY(near(*found.dPrime, dPrime, 1e-12));
        QVERIFY(near(*found.seDPrime, se, 1e-9));
        QVERIFY(near(stats::proportionCorrectAt(*found.dPrime, alternatives), correct / 70.0, 1e-14));
    }

    void sensitivityAtItsEnds()
    {
        const auto below = stats::forcedChoice(20, 70, 3);
        QCOMPARE(*below.dPrime, 0.0);
        QCOMPARE(*below.discriminators, 0.0);
        QVERIFY(!below.seDPrime.exists());
        const auto atChance = stats::forcedChoice(23, 69, 3);  // 1/3, which no double is
        QVERIFY(*atChance.dPrime == 0.0 && atChance.seDPrime.exists());
        const auto perfect = stats::forcedChoice(70, 70, 3);
        QVERIFY(std::isinf(*perfect.dPrime) && !perfect.seDPrime.why().empty());
        for (const auto& refused : {stats::forcedChoice(0, 0, 3), stats::forcedChoice(4, 3, 3), stats::forcedChoice(-1, 3, 3),
                                    stats::forcedChoice(1, 3, 1)})
            QVERIFY(!refused.why.empty() && !refused.dPrime.exists());
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
};

QTEST_GUILESS_MAIN(CountsTest)
#include "counts_test.moc"
