// Properties that hold for all data: scaling by powers of two, the order of participants, the number of threads, and
// tests that are equivalent.
#include <QTest>

#include "stats/tests/bootstrap.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/friedman_exact.h"
#include "stats/tests/intraclass.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/one_way_anova.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "stats/tests/sign_flip.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/wilcoxon.h"
#include "tests/stats/stream.h"

namespace {

constexpr stats::TKind kinds[] = {stats::TKind::OneSample, stats::TKind::Paired, stats::TKind::Student, stats::TKind::Welch};

std::vector<double> scaled(std::vector<double> x, int exponent)
{
    for (double& value : x) value = std::ldexp(value, exponent);
    return x;
}

bool sameTest(const stats::TTest& a, const stats::TTest& b)
{
    return *a.t == *b.t && *a.p == *b.p && *a.logP == *b.logP && *a.df == *b.df;
}

std::vector<std::vector<double>> table(std::uint64_t seed, std::size_t blocks, std::size_t conditions)
{
    Stream stream(seed);
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < blocks; ++i) {
        rows.push_back(stream.ratings(conditions, 5));
        for (std::size_t j = 0; j < conditions; ++j) rows.back()[j] += static_cast<double>(j);
    }
    return rows;
}

stats::BlockTable tableOf(const std::vector<std::vector<double>>& rows) { return stats::blockTableOf(rows).table; }

}  // namespace

class InvariantsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // Small samples are summed exactly, large ones in blocks. Neither may depend on the scale.
    void powersOfTwoChangeNoBitOfAnyTTest_data()
    {
        QTest::addColumn<int>("n");
        QTest::addColumn<int>("exponent");
        for (const int n : {5, 70, 9000})
            for (const int exponent : {-1000, -600, -31, 1, 190, 600, 1000})
                QTest::addRow("%d values, 2^%d", n, exponent) << n << exponent;
    }

    void powersOfTwoChangeNoBitOfAnyTTest()
    {
        QFETCH(int, n);
        QFETCH(int, exponent);
        Stream stream(static_cast<std::uint64_t>(n));
        // Quarters: exact at 2^-1000 as well.
        auto x = stream.ratings(static_cast<std::size_t>(n), 6), y = stream.ratings(static_cast<std::size_t>(n), 5.8);
        for (auto* sample : {&x, &y})
            for (double& value : *sample) value = std::round(value * 4) / 4;
        for (const auto kind : kinds) {
            const auto plain = stats::tTest(kind, x, y, {.mu = 0.25});
            const auto other = stats::tTest(kind, scaled(x, exponent), scaled(y, exponent), {.mu = std::ldexp(0.25, exponent)});
            QVERIFY(sameTest(plain, other));
            QVERIFY(*other.ci.low == std::ldexp(*plain.ci.low, exponent));
        }
    }

    void equivalenceMirrorsForEveryKindOfSample()
    {
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            Stream stream(seed);
            const auto x = stream.ratings(9, 6), y = stream.ratings(9, 6.2);
            for (const auto kind : {stats::TKind::Paired, stats::TKind::Student, stats::TKind::Welch}) {
                const auto one = stats::equivalenceTest(kind, x, y, {-0.3, 0.8, 0.05});
                const auto other = stats::equivalenceTest(kind, y, x, {-0.8, 0.3, 0.05});
                QVERIFY(*one.pLower == *other.pUpper && *one.pUpper == *other.pLower && *one.p == *other.p);
                QVERIFY(*one.ci.low == -*other.ci.high && one.equivalent == other.equivalent);
            }
        }
    }

    void intervalLiesInsideTheBoundsExactlyWhenPIsBelowAlpha()
    {
        int inside = 0;
        for (std::uint64_t seed = 0; seed < 1000; ++seed) {
            Stream stream(seed);
            const double alpha = seed % 2 == 0 ? 0.05 : 0.01;
            const auto x = stream.ratings(12, 6), y = stream.ratings(10, 6.1);
            const auto test = stats::equivalenceTest(stats::TKind::Welch, x, y, {-1.2, 1.2, alpha});
            const bool isInside = *test.ci.low > -1.2 && *test.ci.high < 1.2;
            QCOMPARE(isInside, *test.p < alpha);
            inside += isInside ? 1 : 0;
        }
        QVERIFY(inside > 100 && inside < 900);  // both outcomes occurred
    }

    void orderOfThePairsChangesNoBit()
    {
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            Stream stream(seed);
            std::vector<std::pair<double, double>> pairs;
            for (int i = 0; i < 33; ++i) pairs.emplace_back(stream.ratings(1, 6)[0], stream.ratings(1, 5.5)[0]);
            const auto split = [&] {
                std::pair<std::vector<double>, std::vector<double>> xy;
                for (const auto& [x, y] : pairs) xy.first.push_back(x), xy.second.push_back(y);
                return xy;
            };
            const auto [x, y] = split();
            stream.shuffle(pairs);
            const auto [u, v] = split();
            for (const auto kind : kinds) QVERIFY(sameTest(stats::tTest(kind, x, y), stats::tTest(kind, u, v)));
            QVERIFY(*stats::wilcoxonSignedRank(x, y).pExact == *stats::wilcoxonSignedRank(u, v).pExact);
            QVERIFY(*stats::signFlipTest(x, y).p == *stats::signFlipTest(u, v).p);
            const auto one = stats::bcaBootstrapOfMean(x, {.resamples = 500}),
                       other = stats::bcaBootstrapOfMean(u, {.resamples = 500});
            QVERIFY(*one.ci.low == *other.ci.low && *one.acceleration == *other.acceleration);
        }
    }

    void orderOfTheParticipantsChangesNoBit()
    {
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            auto rows = table(seed, 11, 5);
            const auto before = tableOf(rows);
            Stream(seed + 1000).shuffle(rows);
            const auto after = tableOf(rows);
            const auto a = stats::repeatedMeasuresAnova(before), b = stats::repeatedMeasuresAnova(after);
            QVERIFY(*a.f == *b.f && *a.p == *b.p && *a.pGg == *b.pGg && *a.epsilonGg == *b.epsilonGg);
            QVERIFY(*a.mauchly.w == *b.mauchly.w && *a.moreyHalfWidths[3] == *b.moreyHalfWidths[3]);
            QVERIFY(*stats::friedmanTest(before).q == *stats::friedmanTest(after).q);
            QVERIFY(*stats::intraclassCorrelations(before).icc2 == *stats::intraclassCorrelations(after).icc2);
        }
    }

    void numberOfThreadsChangesNoBit()
    {
        const auto x = Stream(1).numbers(41);
        const auto one = stats::bcaBootstrapOfMean(x, {.resamples = 3001, .threads = 1});
        for (const unsigned threads : {2U, 3U, 8U, 0U}) {
            const auto other = stats::bcaBootstrapOfMean(x, {.resamples = 3001, .threads = threads});
            QVERIFY(*one.ci.low == *other.ci.low && *one.ci.high == *other.ci.high && *one.bias == *other.bias);
            QVERIFY(*one.standardError == *other.standardError);
        }
        QVERIFY(*stats::bcaBootstrapOfMean(x, {.resamples = 3001, .seed = 2}).ci.low != *one.ci.low);
    }

    void everyAdjustmentIsAtLeastTheRawP()
    {
        using enum stats::Adjustment;
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            Stream stream(seed);
            std::vector<stats::Value> p;
            for (int i = 0; i < 20; ++i) p.emplace_back(std::pow(stream.next(), 4));
            for (const auto method : {Holm, Hochberg, Bonferroni, BenjaminiHochberg, BenjaminiYekutieli}) {
                const auto adjusted = stats::adjusted(p, method);
                for (std::size_t i = 0; i < p.size(); ++i)
                    for (std::size_t j = 0; j < p.size(); ++j) {
                        QVERIFY(*adjusted[i] >= *p[i] && *adjusted[i] <= 1);
                        if (*p[i] <= *p[j]) QVERIFY(*adjusted[i] <= *adjusted[j]);
                    }
            }
        }
    }

    // F of two groups is the square of Student's t, of two conditions the square of the paired t.
    void twoLevelsMakeFTheSquareOfT()
    {
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            Stream stream(seed);
            const auto x = stream.ratings(7, 6), y = stream.ratings(12, 5);
            const auto student = stats::studentTTest(x, y);
            const auto anova = stats::oneWayAnova({x, y});
            QVERIFY(near(*anova.f, *student.t * *student.t, 1e-13) && near(*anova.p, *student.p, 1e-12));
            const auto rows = table(seed, 8, 2);
            const auto within = stats::repeatedMeasuresAnova(tableOf(rows));
            const auto paired = stats::pairedTTest(tableOf(rows).column(0), tableOf(rows).column(1));
            QVERIFY(near(*within.f, *paired.t * *paired.t, 1e-12) && near(*within.pGg, *paired.p, 1e-11));
            QCOMPARE(*within.mauchly.w, 1.0);
        }
    }

    // Two conditions: Friedman's exact p is the two-sided sign test.
    void exactFriedmanOfTwoConditionsIsTheSignTest()
    {
        std::vector<std::vector<double>> rows(9, {1, 2});
        rows[2] = rows[5] = {2, 1};
        // 2 (1 + 9 + 36)/512
        QVERIFY(near(*stats::exactFriedman(tableOf(rows)).p, 92.0 / 512, 1e-14));
    }
};

QTEST_GUILESS_MAIN(InvariantsTest)
#include "invariants_test.moc"
