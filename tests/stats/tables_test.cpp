// One-way ANOVA, sphericity, intraclass correlations, exact Friedman: published and independent numbers.
#include <QTest>

#include "stats/tests/friedman_exact.h"
#include "stats/tests/intraclass.h"
#include "stats/tests/one_way_anova.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "tests/stats/exact_numbers.h"
#include "tests/stats/stream.h"

namespace {

using Rows = std::vector<std::vector<double>>;

/// Seven participants, four conditions.
const Rows sevenByFour{{5.1, 6.2, 4.0, 5.6}, {4.4, 4.9, 3.9, 6.0}, {6.6, 7.0, 5.2, 6.9}, {3.1, 5.5, 4.7, 4.8},
                       {5.0, 5.9, 5.0, 6.1}, {4.2, 6.3, 4.5, 4.1}, {5.7, 5.8, 3.3, 6.6}};

stats::BlockTable tableOf(const Rows& rows) { return stats::blockTableOf(rows).table; }

}  // namespace

class TablesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // R: summary(aov(v ~ g)) of c(5.1,4.9,6.2,5.8,5.5), c(6.1,6.4,5.9,7.0), c(4.1,4.4,5.2)
    //   g 2 5.47333333333333 2.73666666666667 10.10807 0.0049979; residuals 9 2.43666666666666 0.27074074074074
    void oneWayAgreesWithR()
    {
        const auto anova = stats::oneWayAnova({{5.1, 4.9, 6.2, 5.8, 5.5}, {6.1, 6.4, 5.9, 7.0}, {4.1, 4.4, 5.2}});
        QVERIFY(near(*anova.ssBetween, 5.47333333333333, 1e-14));
        QVERIFY(near(*anova.ssWithin, 2.43666666666666, 1e-14));
        QVERIFY(near(*anova.f, 10.10807, 1e-6) && near(*anova.p, 0.0049979, 1e-5));
        QVERIFY(near(*anova.rSquared, 5.47333333333333 / 7.91, 1e-14));
        QCOMPARE(*anova.df2, 9.0);
    }

    // R: m <- matrix(c(3,4.6,3,4.8, ...), 6, byrow=TRUE); mauchly.test(lm(m~1), X=~1); anova(lm(m~1), X=~1, test="Spherical")
    //   W = 0.136027236738817, p = 0.204529788521036; F = 0.0730881674103568, p = 0.9735016909089305,
    //   G-G 0.9130953910619699, H-F 0.9651654320407442
    // R's second-order term has 3*p of p = 4 conditions where Box has p = 3 contrasts; with that, the same in 30 digits
    // (mpmath) is 0.204193933160771.
    void sphericityAgreesWithR()
    {
        const Rows rows{{3, 4.6, 3, 4.8},     {5.7, 6.8, 6.4, 5.7}, {5.6, 6, 5.1, 5.5},
                        {3.8, 3.9, 3.6, 5.5}, {4.4, 3.9, 5.1, 2.1}, {6.1, 4.2, 5.0, 5.9}};
        const auto anova = stats::repeatedMeasuresAnova(tableOf(rows));
        QVERIFY(near(*anova.mauchly.w, 0.136027236738817, 1e-13));
        QVERIFY(near(*anova.mauchly.pSecondOrder, 0.204193933160771, 1e-12));
        QVERIFY(near(*anova.f, 0.0730881674103568, 1e-12));
        QVERIFY(near(*anova.p, 0.9735016909089305, 1e-12));
        QVERIFY(near(*anova.pGg, 0.9130953910619699, 1e-12));
        QVERIFY(near(*anova.pHf, 0.9651654320407442, 1e-12));
    }

    // Where sphericity cannot be tested, R prints an uncorrected p; here the reason is returned.
    void sphericityIsOnlyTestedWhereItIsDefined()
    {
        Stream stream(1);
        Rows few;
        for (int i = 0; i < 4; ++i) few.push_back(stream.ratings(6, 5));
        const auto anova = stats::repeatedMeasuresAnova(tableOf(few));
        QVERIFY(anova.pGg.exists() && !anova.mauchly.w.exists());
        QVERIFY(QString::fromStdString(anova.mauchly.why).contains("fewer blocks than conditions"));
        Rows determined;
        for (int i = 0; i < 9; ++i) {
            const auto x = stream.ratings(2, 5);
            determined.push_back({x[0], x[1], (x[0] + x[1]) / 2});
        }
        QVERIFY(QString::fromStdString(stats::mauchlyTest(tableOf(determined)).why).contains("determine others"));
        QVERIFY(!stats::mauchlyTest(tableOf({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}})).w.exists());
    }

    // Shrout and Fleiss (1979), table 2: six targets, four judges; published .17 .29 .71 .44 .62 .91.
    // From the mean squares of R's aov (11.24166.. targets, 32.48611.. judges, 1.01944.. residual).
    void intraclassCorrelationsAreThoseOfShroutAndFleiss()
    {
        const auto icc = stats::intraclassCorrelations(
            tableOf({{9, 2, 5, 8}, {6, 1, 3, 2}, {8, 4, 6, 8}, {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}}));
        const double targets = 56.2083333333333 / 5, judges = 97.4583333333334 / 3, error = 15.2916666666667 / 15;
        const double within = (judges + 5 * error) / 6;
        QVERIFY(near(*icc.icc1, (targets - within) / (targets + 3 * within), 1e-12));
        QVERIFY(near(*icc.icc2, (targets - error) / (targets + 3 * error + 4 * (judges - error) / 6), 1e-12));
        QVERIFY(near(*icc.icc3, (targets - error) / (targets + 3 * error), 1e-12));
        QVERIFY(std::fabs(*icc.icc1 - 0.17) < 0.005 && std::fabs(*icc.icc2 - 0.29) < 0.005 &&
                std::fabs(*icc.icc3 - 0.71) < 0.005);
        QVERIFY(std::fabs(*icc.icc1k - 0.44) < 0.005 && std::fabs(*icc.icc2k - 0.62) < 0.005 &&
                std::fabs(*icc.icc3k - 0.91) < 0.005);
    }

    void perfectAgreementIsOneAndNoVariationIsNothing()
    {
        const auto perfect = stats::intraclassCorrelations(tableOf({{1, 1}, {2, 2}, {5, 5}}));
        QVERIFY(near(*perfect.icc2, 1, 1e-14) && near(*perfect.icc3k, 1, 1e-14));
        // The second rater is always one higher: the raters are consistent but do not agree.
        const auto shifted = stats::intraclassCorrelations(tableOf({{1, 2}, {2, 3}, {3, 4}}));
        QVERIFY(near(*shifted.icc3, 1, 1e-14) && *shifted.icc2 < 0.9);
        QVERIFY(!stats::intraclassCorrelations(tableOf({{2, 2}, {2, 2}})).why.empty());
    }

    // Tables of Friedman's statistic for 3 conditions and 4 blocks (Hollander and Wolfe 1973): P(Q >= 8) = .005, which is
    // the 6 of 6^4 ways in which all blocks agree, and P(Q >= 6.5) = .042.
    void exactFriedmanAgreesWithPublishedTables()
    {
        const auto eight = tableOf({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
        QVERIFY(near(*stats::exactFriedman(eight).p, 6.0 / 1296, 1e-12));
        const auto sixAndHalf = tableOf({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 3, 2}});
        QVERIFY(near(*stats::friedmanTest(sixAndHalf).q, 6.5, 1e-13));
        QVERIFY(std::fabs(*stats::exactFriedman(sixAndHalf).p - 0.042) < 0.0005);
        const auto six = tableOf({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {2, 3, 1}});
        QVERIFY(*stats::exactFriedman(six).p > *stats::exactFriedman(sixAndHalf).p);
    }

    // Ties: the mid-ranks of each block are permuted. The blocks {1, 1, 2} and {1, 2, 2} have 9 pairs of orders: 3 give
    // equal rank sums, the other 6 give the observed statistic.
    void exactFriedmanKnowsTies()
    {
        const auto far = tableOf({{1, 1, 2}, {1, 2, 2}});
        QVERIFY(near(*stats::exactFriedman(far).p, 6.0 / 9, 1e-13));
        QCOMPARE(*stats::exactFriedman(tableOf({{1, 1}, {2, 2}})).p, 1.0);
    }

    void largeDesignsKeepTheirApproximations()
    {
        Stream stream(2);
        Rows rows;
        for (int i = 0; i < 70; ++i) rows.push_back(stream.ratings(9, 5));
        QVERIFY(!stats::exactFriedman(tableOf(rows)).p.exists());
        QVERIFY(stats::friedmanTest(tableOf(rows)).p.exists());
    }

    // Rscript tests/stats/reference/tables.R
    void repeatedMeasuresAsInR()
    {
        const auto anova = stats::repeatedMeasuresAnova(tableOf(sevenByFour));
        QCOMPARE(anova.why, std::string());
        QCOMPARE(anova.blocks, std::size_t{7});
        compareNumbers({{"SS condition", anova.ssCondition, 11.3571428571429},
                        {"SS subject", anova.ssSubject, 9.61714285714286},
                        {"SS error", anova.ssError, 9.14285714285714},
                        {"F", anova.f, 7.453125},
                        {"df1", anova.df1, 3},
                        {"df2", anova.df2, 18},
                        {"p", anova.p, 0.00190246143416872},
                        {"log p", anova.logP, std::log(0.00190246143416872)},
                        {"epsilon GG", anova.epsilonGg, 0.553214120012456},
                        {"p GG", anova.pGg, 0.0128859334769916},
                        {"log p GG", anova.logPGg, std::log(0.0128859334769916)},
                        {"epsilon HF", anova.epsilonHf, 0.738610142146748},
                        {"p HF", anova.pHf, 0.00577362368535085},
                        {"log p HF", anova.logPHf, std::log(0.00577362368535085)},
                        {"partial eta squared", anova.partialEtaSquared, 0.554006968641115},
                        {"generalised eta squared", anova.generalizedEtaSquared, 0.377098946968978},
                        {"ICC(2,1)", anova.icc2, 0.374626960441933},
                        {"ICC(2,k)", anova.icc2k, 0.807444915834132},
                        {"ICC(3,1)", anova.icc3, 0.479674796747968},
                        {"ICC(3,k)", anova.icc3k, 0.865828092243187}});
        compareNumbers({{"W", anova.mauchly.w, 0.123590963287353},
                        {"chi-squared", anova.mauchly.chiSquared, 9.87311762119042},
                        {"df", anova.mauchly.df, 5},
                        {"p, first order", anova.mauchly.pChiSquared, 0.0789112746413326},
                        {"p, second order", anova.mauchly.pSecondOrder, 0.0847159875562773}});
        const auto wide = stats::moreyHalfWidths(tableOf(sevenByFour), 0.99);
        compareNumbers({{"half-width 1", anova.moreyHalfWidths[0], 0.623788153440681},
                        {"half-width 2", anova.moreyHalfWidths[1], 0.508164457485098},
                        {"half-width 3", anova.moreyHalfWidths[2], 0.783199033641004},
                        {"half-width 4", anova.moreyHalfWidths[3], 0.69071662336007},
                        {"half-width 1, 99 %", wide[0], 0.945129951597675},
                        {"half-width 4, 99 %", wide[3], 1.04653633642001}});
        QVERIFY(*stats::mauchlyTest(tableOf(sevenByFour)).w == *anova.mauchly.w);
    }

    void intraclassCorrelationsAsInR()
    {
        const auto icc = stats::intraclassCorrelations(tableOf(sevenByFour));
        compareNumbers({{"ICC(1,1)", icc.icc1, 0.138293400588483},
                        {"ICC(2,1)", icc.icc2, 0.218998031621055},
                        {"ICC(3,1)", icc.icc3, 0.350187836328561},
                        {"ICC(1,k)", icc.icc1k, 0.390968508615567},
                        {"ICC(2,k)", icc.icc2k, 0.528663396689148},
                        {"ICC(3,k)", icc.icc3k, 0.683105565458507}});
    }

    // Rscript tests/stats/reference/tables.R (psych)
    void intraclassIntervalsAsInPsych()
    {
        const auto ci = stats::intraclassIntervals(tableOf(sevenByFour));
        QCOMPARE(ci.why, std::string());
        compareNumbers({{"ICC(2,1) low", ci.icc2.low, -0.01159544442357436},
                        {"ICC(2,1) high", ci.icc2.high, 0.670923480524254},
                        {"ICC(3,1) low", ci.icc3.low, -0.00509349494446346},
                        {"ICC(3,1) high", ci.icc3.high, 0.793984192452228},
                        {"ICC(2,k) low", ci.icc2k.low, -0.04805337853479298},
                        {"ICC(2,k) high", ci.icc2k.high, 0.890772786756379},
                        {"ICC(3,k) low", ci.icc3k.low, -0.02069013507303818},
                        {"ICC(3,k) high", ci.icc3k.high, 0.939083768079092}});
        const auto narrow = stats::intraclassIntervals(tableOf(sevenByFour), 0.90);
        compareNumbers({{"ICC(2,1) low, 90 %", narrow.icc2.low, 0.0152047323606869},
                        {"ICC(2,1) high, 90 %", narrow.icc2.high, 0.598451653675949},
                        {"ICC(3,k) high, 90 %", narrow.icc3k.high, 0.918655523219901}});
    }

    void intervalsThatDoNotExistSayWhy()
    {
        const auto whyOf = [](const Rows& rows) { return stats::intraclassIntervals(tableOf(rows)).why; };
        QCOMPARE(whyOf({{2, 2}, {2, 2}}), std::string("no variation: all values are equal"));
        QCOMPARE(whyOf({{1, 2}, {2, 3}, {3, 4}}), std::string("no error variance: the raters differ by constants only"));
        QCOMPARE(whyOf({{1, 2, 3}}), std::string("needs at least 2 targets"));
        QCOMPARE(whyOf({{1}, {2}, {3}}), std::string("needs at least 2 raters"));
        // Raters who contradict each other: the mean of all has no lower limit.
        const auto contrary = stats::intraclassIntervals(tableOf({{1, 4, 2}, {2, 1, 4}, {3, 3, 1}, {4, 2, 3.5}}));
        QVERIFY(near(*contrary.icc2.low, -0.749874426380010, 1e-9) && near(*contrary.icc3k.high, 0.693241508029083, 1e-9));
        QVERIFY(!contrary.icc2k.low.exists() && !contrary.icc2k.low.why().empty());
    }

    void oneWayNumbersAsInR()
    {
        const auto anova = stats::oneWayAnova({{5.1, 4.9, 6.2, 5.8, 5.5}, {6.1, 6.4, 5.9, 7.0}, {4.1, 4.4, 5.2}});
        QCOMPARE(anova.n, std::size_t{12});
        QCOMPARE(anova.groups, std::size_t{3});
        compareNumbers({{"SS between", anova.ssBetween, 5.47333333333333},
                        {"SS within", anova.ssWithin, 2.43666666666666},
                        {"MS between", anova.msBetween, 2.73666666666667},
                        {"MS within", anova.msWithin, 0.27074074074074},
                        {"df1", anova.df1, 2},
                        {"F", anova.f, 10.1080711354309},
                        {"p", anova.p, 0.00499790934451141},
                        {"log p", anova.logP, std::log(0.00499790934451141)},
                        {"R squared", anova.rSquared, 0.691951116729878},
                        {"omega squared", anova.omegaSquared, 0.602861282144151},
                        {"residual SD", anova.residualSd, 0.520327532176359}});
    }

    // Two conditions are always spherical, with epsilon 1. For few blocks Huynh and Feldt's epsilon is undefined.
    void epsilonAtItsEnds()
    {
        const auto two = stats::repeatedMeasuresAnova(tableOf({{1, 2}, {2, 5}, {3, 4}}));
        compareNumbers({{"epsilon GG", two.epsilonGg, 1},
                        {"epsilon HF", two.epsilonHf, 1},
                        {"p HF", two.pHf, *two.p},
                        {"W", two.mauchly.w, 1},
                        {"chi-squared", two.mauchly.chiSquared, 0},
                        {"df", two.mauchly.df, 0}});
        compareReasons({{"p of sphericity", two.mauchly.pSecondOrder, "two conditions"}});
        // Two blocks: one difference, so that epsilon is 1/(k - 1), and n - 1 - (k - 1) epsilon is 0.
        const auto few = stats::repeatedMeasuresAnova(tableOf({{1, 2, 4}, {2, 5, 3}}));
        compareNumbers({{"least epsilon", few.epsilonGg, 0.5}});
        compareReasons({{"epsilon HF", few.epsilonHf, "too few blocks"}, {"p HF", few.pHf, "too few blocks"}});
        const auto none = stats::repeatedMeasuresAnova(tableOf({{1, 2, 4}, {2, 3, 5}, {0, 1, 3}}));
        compareNumbers({{"SS condition", none.ssCondition, 14}, {"SS subject", none.ssSubject, 6}});
        compareReasons({{"F", none.f, "no error variance"}, {"ICC", none.icc2, "no error variance"}});
        compareReasons({{"one condition", stats::repeatedMeasuresAnova(tableOf({{1}, {2}})).f, "at least 2 conditions"},
                        {"one block", stats::moreyHalfWidths(tableOf({{1, 2}}))[1], "at least 2 complete blocks"}});
    }
};

QTEST_GUILESS_MAIN(TablesTest)
#include "tables_test.moc"
