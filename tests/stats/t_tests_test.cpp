// Every number of the t tests and of the equivalence tests against R.
#include "stats/tests/t_tests.h"

#include <QTest>
#include <limits>
#include <numbers>
#include <vector>

#include "stats/tests/equivalence.h"
#include "tests/stats/exact_numbers.h"

namespace {

using stats::Tail;
using stats::TKind;
using stats::TOptions;

constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<double> x{5.1, 4.3, 6.2, 5.9, 4.8, 7.0, 5.5};
const std::vector<double> y{4.6, 4.4, 5.0, 5.2, 4.9, 5.8, 5.6};
const std::vector<double> z{6.1, 5.2, 7.4, 4.9, 6.6};

const std::vector<double>& second(TKind kind) { return kind == TKind::Paired ? y : z; }

struct Expected {
    double t, df, se, p, logP, low, high;
};

struct ExpectedBounds {
    double tLower, pLower, tUpper, pUpper, low, high, tDifference, pDifference, df, se;
};

}  // namespace

class TTestsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // All numbers of this file: Rscript tests/stats/reference/t_tests.R
    void everyKindAndTailAsInR_data()
    {
        QTest::addColumn<TKind>("kind");
        QTest::addColumn<TOptions>("options");
        QTest::addColumn<Expected>("expected");
        QTest::newRow("one, two-sided") << TKind::OneSample << TOptions{5.2, Tail::TwoSided, 0.95}
                                        << Expected{0.995973524055722, 6.0,
                                                    0.344243229941482, 0.357718256957227,
                                                    -1.0280095941616,  4.70052430383691,
                                                    6.38518998187738};
        QTest::newRow("one, less") << TKind::OneSample << TOptions{5.2, Tail::Less, 0.99}
                                   << Expected{0.995973524055722,  6.0,       0.344243229941482, 0.821140871521387,
                                               -0.197060598960855, -infinity, 6.62469946464107};
        QTest::newRow("one, greater") << TKind::OneSample << TOptions{5.2, Tail::Greater, 0.9}
                                      << Expected{
                                             0.995973524055722, 6.0,     0.344243229941482, 0.178859128478613, -1.72115677472154,
                                             5.04723097409178,  infinity};
        QTest::newRow("paired, two-sided") << TKind::Paired << TOptions{0.2, Tail::TwoSided, 0.95}
                                           << Expected{1.21552036925606,  6.0,
                                                       0.223302363575112, 0.269820365174605,
                                                       -1.30999885557158, -0.0749726283920518,
                                                       1.01782977124919};
        QTest::newRow("paired, less") << TKind::Paired << TOptions{0.2, Tail::Less, 0.99}
                                      << Expected{1.21552036925606,   6.0,       0.223302363575112, 0.865089817412698,
                                                  -0.144921942281567, -infinity, 1.17319385381627};
        QTest::newRow("paired, greater") << TKind::Paired << TOptions{0.2, Tail::Greater, 0.9}
                                         << Expected{1.21552036925606,  6.0,
                                                     0.223302363575112, 0.134910182587303,
                                                     -2.00314603613152, 0.149927710093413,
                                                     infinity};
        QTest::newRow("student, two-sided") << TKind::Student << TOptions{0.2, Tail::TwoSided, 0.95}
                                            << Expected{-1.24472948367065, 10.0,
                                                        0.560075796619693, 0.241612134734115,
                                                        -1.4204215876343,  -1.74506949964836,
                                                        0.750783785362643};
        QTest::newRow("student, less") << TKind::Student << TOptions{0.2, Tail::Less, 0.99}
                                       << Expected{-1.24472948367065, 10.0,      0.560075796619693, 0.120806067367058,
                                                   -2.11356876819424, -infinity, 1.05077752378279};
        QTest::newRow("student, greater")
            << TKind::Student << TOptions{0.2, Tail::Greater, 0.9}
            << Expected{-1.24472948367065, 10.0,    0.560075796619693, 0.879193932632942, -0.128749776925475,
                        -1.26566970304624, infinity};
        QTest::newRow("welch, two-sided") << TKind::Welch << TOptions{0.2, Tail::TwoSided, 0.95}
                                          << Expected{-1.21893136405216, 8.09415541243262,  0.571929542304421, 0.257200318732402,
                                                      -1.35790004737993, -1.81334906643979, 0.819063352154077};
        QTest::newRow("welch, less") << TKind::Welch << TOptions{0.2, Tail::Less, 0.99}
                                     << Expected{-1.21893136405216, 8.09415541243262, 0.571929542304421, 0.128600159366201,
                                                 -2.05104722793988, -infinity,        1.15484598741761};
        QTest::newRow("welch, greater") << TKind::Welch << TOptions{0.2, Tail::Greater, 0.9}
                                        << Expected{-1.21893136405216,  8.09415541243262,  0.571929542304421, 0.871399840633799,
                                                    -0.137654348184055, -1.29519037430244, infinity};
    }

    void everyKindAndTailAsInR()
    {
        QFETCH(TKind, kind);
        QFETCH(TOptions, options);
        QFETCH(Expected, expected);
        const auto test = stats::tTest(kind, x, second(kind), options);
        QCOMPARE(test.why, std::string());
        compareNumbers({{"t", test.t, expected.t},
                        {"df", test.df, expected.df},
                        {"se", test.se, expected.se},
                        {"p", test.p, expected.p},
                        {"log p", test.logP, expected.logP},
                        {"log10 p", test.log10P(), expected.logP / std::numbers::ln10},
                        {"low", test.ci.low, expected.low},
                        {"high", test.ci.high, expected.high}});
    }

    void estimatesAndEffectSizesAsInR()
    {
        const auto one = stats::oneSampleTTest(x, {.mu = 5.2});
        compareNumbers({{"mean", one.estimate, 5.54285714285714},
                        {"sd", one.sd, 0.910781976942786},
                        {"dZ", one.dZ, 0.376442608150864},
                        {"gZ", one.hedgesGz, 0.326988095875198}});
        QCOMPARE(one.n, std::size_t{7});
        QCOMPARE(one.nSecond, std::size_t{0});
        const auto paired = stats::pairedTTest(x, y, {.mu = 0.2});
        compareNumbers({{"mean", paired.estimate, 0.471428571428571},
                        {"sd", paired.sd, 0.590802521192673},
                        {"dZ", paired.dZ, 0.459423515797849},
                        {"gZ", paired.hedgesGz, 0.399067526837511},
                        {"dAv", paired.dAvLakens, 0.665641454930359},
                        {"dAv rms", paired.dAvRms, 0.639982918345354}});
        const auto student = stats::studentTTest(x, z, {.mu = 0.2});
        compareNumbers({{"difference", student.estimate, -0.497142857142857},
                        {"sd", student.sd, 0.956511518861266},
                        {"dS", student.dS, -0.519745813134284},
                        {"gS", student.hedgesGs, -0.479593166373641}});
        QCOMPARE(student.nSecond, std::size_t{5});
        const auto welch = stats::welchTTest(x, z, {.mu = 0.2});
        compareNumbers({{"difference", welch.estimate, -0.497142857142857}, {"dAv rms", welch.dAvRms, -0.513786309195261}});
        compareReasons({{"sd", welch.sd, "pools no SD"},
                        {"dZ", welch.dZ, "not an effect size"},
                        {"dS", paired.dS, "not an effect size"},
                        {"dAv", student.dAvLakens, "not an effect size"}});
        // With one degree of freedom t exists (2 for 1 and 3), but no corrected effect size.
        const auto two = stats::oneSampleTTest(std::vector<double>{1, 3});
        compareNumbers({{"t", two.t, 2}, {"dZ", two.dZ, std::sqrt(2)}});
        compareReasons({{"gZ", two.hedgesGz, "at least 2 degrees of freedom"}});
    }

    void equivalenceAsInR_data()
    {
        QTest::addColumn<TKind>("kind");
        QTest::addColumn<stats::EquivalenceOptions>("options");
        QTest::addColumn<ExpectedBounds>("expected");
        QTest::newRow("one") << TKind::OneSample << stats::EquivalenceOptions{4.9, 6.4, 0.05}
                             << ExpectedBounds{1.86745035760448,   0.0555353518926687,   -2.48993381013931,
                                               0.0235832260542998, 4.87393048673396,     6.21178379898033,
                                               16.1015719722342,   3.64757342358852e-06, 6.0,
                                               0.344243229941482};
        QTest::newRow("paired") << TKind::Paired << stats::EquivalenceOptions{-0.5, 1.2, 0.025}
                                << ExpectedBounds{4.35028342681117,    0.00241054588721365, -3.26271257010838,
                                                  0.00859515409990881, -0.0749726283920518, 1.01782977124919,
                                                  2.11116695712895,    0.0792448901463881,  6.0,
                                                  0.223302363575112};
        QTest::newRow("student") << TKind::Student << stats::EquivalenceOptions{-1.5, 1.1, 0.05}
                                 << ExpectedBounds{1.79057397036228,    0.0518151221087861, -2.85165484168808,
                                                   0.00860061023151623, -1.51225846434383,  0.517972750058115,
                                                   -0.887634959666774,  0.395584573021915,  10.0,
                                                   0.560075796619693};
        QTest::newRow("welch") << TKind::Welch << stats::EquivalenceOptions{-1.5, 1.1, 0.1}
                               << ExpectedBounds{1.7534627409111,   0.058586916266114, -2.79255177256213,  0.011599887946146,
                                                 -1.29519037430244, 0.300904660016728, -0.869237939938838, 0.409751202622098,
                                                 8.09415541243262,  0.571929542304421};
    }

    void equivalenceAsInR()
    {
        QFETCH(TKind, kind);
        QFETCH(stats::EquivalenceOptions, options);
        QFETCH(ExpectedBounds, expected);
        const auto test = stats::equivalenceTest(kind, x, second(kind), options);
        QCOMPARE(test.why, std::string());
        compareNumbers({{"t lower", test.tLower, expected.tLower},
                        {"p lower", test.pLower, expected.pLower},
                        {"log p lower", test.logPLower, std::log(expected.pLower)},
                        {"t upper", test.tUpper, expected.tUpper},
                        {"p upper", test.pUpper, expected.pUpper},
                        {"log p upper", test.logPUpper, std::log(expected.pUpper)},
                        {"p", test.p, std::max(expected.pLower, expected.pUpper)},
                        {"log p", test.logP, std::log(std::max(expected.pLower, expected.pUpper))},
                        {"low", test.ci.low, expected.low},
                        {"high", test.ci.high, expected.high},
                        {"t", test.tDifference, expected.tDifference},
                        {"p of the difference", test.pDifference, expected.pDifference},
                        {"log p of the difference", test.logPDifference, std::log(expected.pDifference)},
                        {"df", test.df, expected.df},
                        {"se", test.se, expected.se}});
        const bool isTwoSamples = kind == TKind::Student || kind == TKind::Welch;
        QCOMPARE(test.nSecond, std::size_t{isTwoSamples ? 5U : 0U});
        QCOMPARE(test.dZ.exists(), !isTwoSamples);
        QCOMPARE(test.equivalent, std::max(expected.pLower, expected.pUpper) < options.alpha);
        QCOMPARE(test.different, expected.pDifference < options.alpha);
    }

    void effectSizesOfEquivalenceAsInR()
    {
        compareNumbers({{"one sample", stats::equivalenceTest(TKind::OneSample, x, {}).dZ, 6.08582216510564},
                        {"pairs", stats::equivalenceTest(TKind::Paired, x, y).dZ, 0.797946106385738},
                        {"mean of pairs", stats::equivalenceTest(TKind::Paired, x, y).estimate, 0.471428571428571}});
    }

    void verdictsNameAllFourCells()
    {
        const auto verdict = [](double low, double high, double alpha) {
            return stats::equivalenceTest(TKind::OneSample, std::vector<double>{0.2, 0.3, 0.1, 0.3, 0.2, 0.1}, {},
                                          {low, high, alpha})
                .verdict();
        };
        QCOMPARE(verdict(-1, 1, 0.05), std::string("different / equivalent"));
        QCOMPARE(verdict(-0.1, 0.1, 0.05), std::string("different / not shown equivalent"));
        QCOMPARE(verdict(-1, 1, 0.0001), std::string("not different / equivalent"));
        QCOMPARE(verdict(-0.1, 0.1, 0.0001), std::string("not different / not shown equivalent"));
        QCOMPARE(stats::equivalenceTest(TKind::OneSample, {}, {}).verdict(), std::string("undefined: there are no values"));
    }

    void boundsAndAlphaMustMakeSense()
    {
        for (const stats::EquivalenceOptions& options :
             {stats::EquivalenceOptions{0.5, 0.5, 0.05}, stats::EquivalenceOptions{1, -1, 0.05},
              stats::EquivalenceOptions{-infinity, 1, 0.05}, stats::EquivalenceOptions{-1, 1, 0.5},
              stats::EquivalenceOptions{-1, 1, 0}}) {
            const auto test = stats::equivalenceTest(TKind::OneSample, x, {}, options);
            QVERIFY(!test.why.empty() && !test.p.exists() && !test.equivalent && !test.different);
        }
    }

    // A constant sample has an estimate and a spread of 0, but no t.
    void constantSamplesKeepTheirEstimate()
    {
        const std::vector<double> same(4, 0.5);
        const auto one = stats::oneSampleTTest(same);
        compareNumbers({{"mean", one.estimate, 0.5}, {"sd", one.sd, 0}, {"se", one.se, 0}});
        compareReasons({{"t", one.t, "all values are equal"}, {"p", one.p, "all values are equal"}});
        const auto one1 = stats::oneSampleTTest(std::vector<double>{3});
        compareNumbers({{"mean of one value", one1.estimate, 3}});
        compareReasons({{"sd of one value", one1.sd, "at least 2 values"}});
        const auto pair = stats::pairedTTest(std::vector<double>{3}, std::vector<double>{1});
        compareNumbers({{"difference of one pair", pair.estimate, 2}});
        compareReasons({{"t of one pair", pair.t, "at least 2 pairs"}});
        compareReasons({{"Welch", stats::welchTTest(std::vector<double>{1, 2}, std::vector<double>{3}).t, "in each sample"},
                        {"Student", stats::studentTTest(std::vector<double>{1}, std::vector<double>{3}).t, "at least 3 values"},
                        {"both constant", stats::welchTTest(same, same).t, "both samples are constant"}});
        QVERIFY(stats::studentTTest(std::vector<double>{1, 2}, std::vector<double>{3}).t.exists());
        QVERIFY(stats::welchTTest(same, x).t.exists());
    }
};

QTEST_GUILESS_MAIN(TTestsTest)
#include "t_tests_test.moc"
