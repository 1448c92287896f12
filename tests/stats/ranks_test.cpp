// Rank tests, sign flips and tests on complete blocks, number by number against R.
#include <QTest>
#include <limits>
#include <vector>

#include "stats/tests/friedman_exact.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/sign_flip.h"
#include "stats/tests/wilcoxon.h"
#include "tests/stats/exact_numbers.h"

namespace {

using stats::Tail;
using stats::ZeroMethod;

const std::vector<double> differences{0.3, -0.1, 0.5, 0.5, 0, 0.2, -0.4, 0.6, 0.1, 0.9, -0.2, 0};
const std::vector<double> negative{-0.7, -0.3, 0.2, -0.5, 0.1, -0.6};

struct Expected {
    double exact, normal, zCorrected, normalCorrected;
};

stats::BlockTable ratings()
{
    return stats::blockTableOf({{5.1, 6.2, 4.0, 5.1},
                                {4.4, 4.4, 3.9, 6.0},
                                {6.6, 7.0, 5.2, 6.6},
                                {3.1, 5.5, 4.7, 4.9},
                                {5.0, 5.9, 5.0, 6.1},
                                {4.2, 6.3, 4.5, 4.1}})
        .table;
}

stats::BlockTable withoutLastCondition(const stats::BlockTable& table)
{
    stats::BlockTable result{table.blocks, table.conditions - 1, {}};
    for (std::size_t i = 0; i < table.blocks; ++i)
        for (std::size_t j = 0; j + 1 < table.conditions; ++j) result.values.push_back(table.at(i, j));
    return result;
}

}  // namespace

class RanksTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // All numbers of this file: Rscript tests/stats/reference/ranks.R
    void signedRanksAsInR_data()
    {
        QTest::addColumn<ZeroMethod>("zeros");
        QTest::addColumn<Tail>("tail");
        QTest::addColumn<Expected>("expected");
        QTest::newRow("wilcox, two-sided") << ZeroMethod::Wilcox << Tail::TwoSided
                                           << Expected{0.103515625, 0.0919651053528496, 1.63405734780213, 0.102246809586542};
        QTest::newRow("wilcox, less") << ZeroMethod::Wilcox << Tail::Less
                                      << Expected{0.95703125, 0.954017447323575, 1.73618593203976, 0.958734518048899};
        QTest::newRow("wilcox, greater") << ZeroMethod::Wilcox << Tail::Greater
                                         << Expected{0.0517578125, 0.0459825526764248, 1.63405734780213, 0.0511234047932712};
        QTest::newRow("pratt, two-sided") << ZeroMethod::Pratt << Tail::TwoSided
                                          << Expected{0.11328125, 0.106039433328682, 1.57683305597089, 0.114833943395007};
        QTest::newRow("pratt, less") << ZeroMethod::Pratt << Tail::Less
                                     << Expected{0.947265625, 0.946980283335659, 1.65567470876943, 0.951106144134097};
        QTest::newRow("pratt, greater") << ZeroMethod::Pratt << Tail::Greater
                                        << Expected{0.056640625, 0.0530197166643408, 1.57683305597089, 0.0574169716975034};
    }

    void signedRanksAsInR()
    {
        QFETCH(ZeroMethod, zeros);
        QFETCH(Tail, tail);
        QFETCH(Expected, expected);
        const auto test = stats::wilcoxonSignedRank(differences, {}, {.tail = tail, .zeros = zeros});
        QCOMPARE(test.nUsed, std::size_t{10});
        QCOMPARE(test.nZero, std::size_t{2});
        compareNumbers({{"exact p", test.pExact, expected.exact},
                        {"log of the exact p", test.logPExact, std::log(expected.exact)},
                        {"normal p", test.pNormal, expected.normal},
                        {"corrected z", test.zCorrected, expected.zCorrected},
                        {"corrected p", test.pNormalCorrected, expected.normalCorrected},
                        {"v", test.v, zeros == ZeroMethod::Wilcox ? 44.0 : 58.0},
                        {"z", test.z, zeros == ZeroMethod::Wilcox ? 1.68512163992095 : 1.61625388237016},
                        {"rank biserial", test.rankBiserial, zeros == ZeroMethod::Wilcox ? 0.6 : 0.546666666666667},
                        {"Hodges-Lehmann", test.hodgesLehmann, 0.2}});
    }

    void pairsAreTestedByTheirDifferences()
    {
        const std::vector<double> first{5.3, 4.9, 5.5, 5.5, 5};
        const std::vector<double> second{5, 5, 5, 5, 5};
        const auto test = stats::wilcoxonSignedRank(first, second);
        compareNumbers({{"Hodges-Lehmann", test.hodgesLehmann, 0.25}, {"v", test.v, 9}});
        const auto binary = stats::wilcoxonSignedRank(first, second, {.arithmetic = stats::Arithmetic::Double});
        compareNumbers({{"binary Hodges-Lehmann", binary.hodgesLehmann, 0.25}});
    }

    // The rank sums are equal, so that there is no excess to correct.
    void noExcessIsNotCorrected()
    {
        const auto test = stats::wilcoxonSignedRank(std::vector<double>{1, -1, 2, -2}, {});
        compareNumbers({{"z", test.z, 0},
                        {"corrected z", test.zCorrected, 0},
                        {"p", test.pNormalCorrected, 1},
                        {"exact p", test.pExact, 1}});
    }

    // The exact p exists for up to 1000 differences. For 1000 equal ones it is 2 / 2^1000.
    void longSamplesKeepTheNormalApproximation()
    {
        compareReasons({{"exact p", stats::wilcoxonSignedRank(std::vector<double>(1001, 1.0), {}).pExact, "more than 1000"}});
        const auto test = stats::wilcoxonSignedRank(std::vector<double>(1000, 1.0), {});
        compareNumbers({{"log p", test.logPExact, -999 * std::log(2.0)}});
        const std::vector<double> many(5001, 1.0);
        compareReasons({{"Hodges-Lehmann", stats::wilcoxonSignedRank(many, {}).hodgesLehmann, "more than 5000"}});
    }

    void signFlipsAsInR()
    {
        compareNumbers({{"two-sided", stats::signFlipTest(differences, {}).p, 0.107421875},
                        {"less", stats::signFlipTest(differences, {}, Tail::Less).p, 0.9619140625},
                        {"greater", stats::signFlipTest(differences, {}, Tail::Greater).p, 0.0537109375},
                        {"log p", stats::signFlipTest(differences, {}, Tail::Less).logP, std::log(0.9619140625)},
                        {"mean", stats::signFlipTest(differences, {}).meanDifference, 0.2},
                        {"negative two-sided", stats::signFlipTest(negative, {}).p, 0.15625},
                        {"negative less", stats::signFlipTest(negative, {}, Tail::Less).p, 0.078125},
                        {"negative greater", stats::signFlipTest(negative, {}, Tail::Greater).p, 0.953125},
                        {"negative mean", stats::signFlipTest(negative, {}).meanDifference, -0.3}});
        QCOMPARE(stats::signFlipTest(differences, {}).nZero, std::size_t{2});
        QCOMPARE(stats::signFlipTest(differences, {}).n, std::size_t{12});
    }

    // Sevenths lie on no decimal grid: the test then enumerates all signs.
    void signFlipsWithoutAGridAreTheSame()
    {
        auto sevenths = negative;
        for (double& value : sevenths) value = value * 10 / 7;
        sevenths.push_back(0);
        compareNumbers({{"two-sided", stats::signFlipTest(sevenths, {}).p, 0.15625},
                        {"log p", stats::signFlipTest(sevenths, {}).logP, std::log(0.15625)},
                        {"less", stats::signFlipTest(sevenths, {}, Tail::Less).p, 0.078125},
                        {"greater", stats::signFlipTest(sevenths, {}, Tail::Greater).p, 0.953125},
                        {"mean", stats::signFlipTest(sevenths, {}).meanDifference, 10 * 6 * -0.3 / 49}});
        QCOMPARE(stats::signFlipTest(sevenths, {}).nZero, std::size_t{1});
        const std::vector<double> ones(7, 1.0);
        auto shifted = sevenths;
        for (double& value : shifted) value += 1;
        compareNumbers({{"pairs", stats::signFlipTest(shifted, ones).p, 0.15625}});
        // The signs of up to 22 differences are enumerated.
        std::vector<double> thirds(22, 1.0 / 3);
        compareNumbers({{"22 alike", stats::signFlipTest(thirds, {}).p, std::ldexp(1, -21)}});
        thirds.push_back(1.0 / 3);
        compareReasons({{"23 alike", stats::signFlipTest(thirds, {}).p, "no decimal grid"}});
    }

    void friedmanWithTiesAsInR()
    {
        const auto test = stats::friedmanTest(ratings());
        compareNumbers({{"q", test.q, 9.16071428571429},
                        {"df", test.df, 3},
                        {"p", test.p, 0.0272286845397802},
                        {"log p", test.logP, -3.60348428268924},
                        {"W", test.kendallW, 0.508928571428572},
                        {"F", test.imanDavenportF, 5.18181818181818},
                        {"df1", test.fDf1, 3},
                        {"df2", test.fDf2, 15},
                        {"p of F", test.fP, 0.0117657958902669},
                        {"log p of F", test.fLogP, std::log(0.0117657958902669)}});
        QCOMPARE(test.blocks, std::size_t{6});
    }

    /// Three means that are 37/6 by different sums differ in the last bit. Every block then seemed to rank them alike.
    void meansThatRoundingTellsApartAreTied()
    {
        const double mean = 37.0 / 6, above = std::nextafter(mean, 7), below = std::nextafter(mean, 6);
        QVERIFY(below < mean && mean < above);
        const std::vector<std::vector<double>> alike(4, {below, mean, above});
        compareReasons({{"q", stats::friedmanTest(stats::blockTableOf(alike).table).q, "all conditions alike"}});
        compareNumbers({{"exact p", stats::exactFriedman(stats::blockTableOf(alike).table).p, 1}});
        const std::vector<std::vector<double>> first{{below, mean, 8}, {above, mean, 8}, {mean, below, 8}},
            exact{{1, 1, 2}, {1, 1, 2}, {1, 1, 2}};
        compareNumbers({{"q", stats::friedmanTest(stats::blockTableOf(first).table).q,
                         *stats::friedmanTest(stats::blockTableOf(exact).table).q}});
        // Differences of such means are zero, or of equal size.
        const std::vector<double> x{above, 37.0 / 6 + 1, 37.0 / 6 - 1, above + 2}, y{below, below, above, 37.0 / 6};
        const auto test = stats::wilcoxonSignedRank(x, y);
        QCOMPARE(test.nZero, std::size_t{1});
        compareNumbers({{"V", test.v, 4.5}});  // differences 1, -1, 2: mid-ranks 1.5, 1.5, 3
        QCOMPARE(stats::wilcoxonSignedRank(x, y, {.arithmetic = stats::Arithmetic::Double}).nZero, std::size_t{0});
        // Large whole numbers are exact.
        const std::vector<double> large{1e16 + 2, 1e16 + 4, 1e16 + 8}, same(3, 1e16);
        compareNumbers({{"V of large numbers", stats::wilcoxonSignedRank(large, same).v, 6}});
        // What is small beside other numbers is no rounding: microseconds of an epoch, and values of many magnitudes.
        const std::vector<double> stamps{1700000000.000101, 1700000000.000203, 1700000000.000307}, epoch(3, 1700000000.0);
        QCOMPARE(stats::wilcoxonSignedRank(stamps, epoch).nZero, std::size_t{0});
        const std::vector<std::vector<double>> wide(3, {1e-20 / 3, 2e-20 / 3, 0.3});
        compareNumbers({{"q of many magnitudes", stats::friedmanTest(stats::blockTableOf(wide).table).q, 6}});
    }

    // Three blocks that agree: Q = n (k - 1), W = 1, and F is infinite.
    void perfectAgreementHasNoF()
    {
        const auto test = stats::friedmanTest(stats::blockTableOf({{1, 2, 3}, {2, 4, 5}, {0, 1, 9}}).table);
        compareNumbers({{"q", test.q, 6}, {"W", test.kendallW, 1}, {"p", test.p, std::exp(-3.0)}});
        compareReasons(
            {{"F", test.imanDavenportF, "rank the conditions alike"}, {"p of F", test.fP, "rank the conditions alike"}});
        compareReasons(
            {{"one block", stats::friedmanTest(stats::blockTableOf({{1, 2, 2}}).table).imanDavenportF, "2 blocks"},
             {"ties only", stats::friedmanTest(stats::blockTableOf({{1, 1}, {2, 2}}).table).q, "all conditions alike"}});
    }

    void exactFriedmanAsInR()
    {
        const auto ties = stats::exactFriedman(withoutLastCondition(ratings()));
        compareNumbers({{"ties", ties.p, 0.0118312757201646}, {"its logarithm", ties.logP, std::log(0.0118312757201646)}});
        const auto plain =
            stats::exactFriedman(stats::blockTableOf({{1, 2, 3}, {2, 1, 3}, {1, 3, 2}, {1, 2, 3}, {3, 2, 1}}).table);
        compareNumbers({{"plain", plain.p, 0.521604938271605}, {"its logarithm", plain.logP, std::log(0.521604938271605)}});
    }

    void cochranAsInR()
    {
        const auto test = stats::cochranTest(
            stats::blockTableOf({{1, 1, 0}, {1, 0, 1}, {1, 1, 1}, {0, 0, 1}, {1, 0, 1}, {0, 0, 0}, {1, 1, 0}}).table);
        compareNumbers({{"q", test.q, 1.2},
                        {"df", test.df, 2},
                        {"p", test.p, 0.548811636094026},
                        {"log p", test.logP, std::log(0.548811636094026)}});
        compareReasons(
            {{"ratings", stats::cochranTest(ratings()).q, "0 and 1"},
             {"all alike", stats::cochranTest(stats::blockTableOf({{1, 1}, {0, 0}}).table).p, "both successes and failures"}});
    }
};

QTEST_GUILESS_MAIN(RanksTest)
#include "ranks_test.moc"
