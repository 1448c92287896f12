// Extreme data, for which other programs fail: tiny and huge scales, offsets, long samples, empty samples, and
// probabilities below the smallest double. The source of each expected value stands above it.
#include <QTest>
#include <limits>
#include <numbers>

#include "stats/kernels/descriptive.h"
#include "stats/kernels/distributions.h"
#include "stats/metrics/trace_error.h"
#include "stats/tests/bootstrap.h"
#include "stats/tests/intraclass.h"
#include "stats/tests/one_way_anova.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "stats/tests/sign_flip.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/wilcoxon.h"
#include "tests/stats/stream.h"

namespace {

const double notANumber = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

using Numbers = std::vector<double>;

}  // namespace

class ExtremesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // {1, 2} times any power of two: mean 1.5, se 0.5, t = 3 with 1 degree of freedom, where T is Cauchy:
    // p = 1 - 2 atan(3)/pi. R, scipy and Boost 1.74 fail beyond 2^±512.
    void oneAndTwoAtEveryScale()
    {
        for (int exponent = -1074; exponent <= 1022; exponent += 131) {
            const auto test = stats::oneSampleTTest(Numbers{std::ldexp(1, exponent), std::ldexp(2, exponent)});
            QVERIFY(*test.t == 3);
            QVERIFY(near(*test.p, 1 - 2 * std::atan(3) / std::numbers::pi, 1e-15));
        }
    }

    // {1, 2, 3}: t = 2 sqrt 3 with 2 degrees of freedom, p = 1 - t/sqrt(2 + t^2) = 1 - sqrt(6/7).
    void denormals()
    {
        const double smallest = std::numeric_limits<double>::denorm_min();
        const auto test = stats::oneSampleTTest(Numbers{smallest, 2 * smallest, 3 * smallest});
        QVERIFY(near(*test.t, 2 * std::sqrt(3), 1e-15));
        QVERIFY(near(*test.p, 1 - std::sqrt(6.0 / 7), 1e-14));
        const auto error = stats::traceError(Numbers{smallest, 3 * smallest}, Numbers{smallest, smallest});
        QCOMPARE(*error.mae, smallest);
        QVERIFY(near(*error.maeOverMean, 1, 1e-15));
    }

    // Three numbers near 1e308: t is that of the scaled numbers; an end beyond the range of double is a decimal.
    void sumsBeyondTheLargestDouble()
    {
        const Numbers x{1e308, 1.2e308, 1.5e308};
        const auto large = stats::oneSampleTTest(x);
        const auto small = stats::oneSampleTTest(Numbers{1.0, 1.2, 1.5});
        QVERIFY(near(*large.t, *small.t, 1e-14));
        QVERIFY(near(*large.estimate, 1.2333333333333333e308, 1e-15));
        QVERIFY(!large.ci.high.exists());
        // R: 37/30 + qt(.975, 2) * sd(c(1, 1.2, 1.5))/sqrt(3)      1.85849428127091
        QVERIFY2(large.ci.high.decimal().starts_with("1.858494281270"), large.ci.high.decimal().c_str());
        QVERIFY(large.ci.high.decimal().ends_with("e+308"));
        const auto error = stats::traceError(Numbers{1e308, -1e308}, Numbers{-1e308, 1e308});
        QVERIFY(error.mae.decimal().starts_with("2.00000000000000") && error.mae.decimal().ends_with("e+308"));
        QCOMPARE(*error.bias, 0.0);
        QVERIFY(stats::describe(Numbers{1e200, 3e200}).variance.decimal().starts_with("1.99999999999999") ||
                stats::describe(Numbers{1e200, 3e200}).variance.decimal().starts_with("2.00000000000000"));
    }

    // 1e15 + {1, 2, 3, 5, 8}: as {1, 2, 3, 5, 8}, t = 3.0621272632964452.
    void offsetsCostNoDigits()
    {
        const auto plain = stats::oneSampleTTest(Numbers{1, 2, 3, 5, 8});
        for (const double offset : {1e6, 1e9, 1e12, 1e15}) {
            const auto test =
                stats::oneSampleTTest(Numbers{offset + 1, offset + 2, offset + 3, offset + 5, offset + 8}, {.mu = offset});
            QVERIFY(near(*test.t, *plain.t, 1e-14));
        }
        // scipy and Boost lose these, R refuses: 1e16 + {2, 4, 6, 10}, variance 35/3, t = 5.5/sqrt(35/12).
        const auto even = stats::oneSampleTTest(Numbers{1e16 + 2, 1e16 + 4, 1e16 + 6, 1e16 + 10}, {.mu = 1e16});
        QVERIFY(near(*even.t, 5.5 / std::sqrt(35.0 / 12), 1e-14));
    }

    // n/2 zeros and n/2 ones on an offset of 1e9: mean 1e9 + 1/2, variance n/(4 (n - 1)).
    void tenMillionValues()
    {
        constexpr std::size_t n = 10000000;
        Numbers x(n);
        for (std::size_t i = 0; i < n; ++i) x[i] = 1e9 + static_cast<double>(i % 2);
        const double variance = 0.25 * n / (n - 1.0);
        const auto test = stats::oneSampleTTest(x, {.mu = 1e9 + 0.25});
        QCOMPARE(*test.estimate, 1e9 + 0.5);
        QVERIFY(near(*test.sd, std::sqrt(variance), 1e-14));
        QVERIFY(near(*test.t, 0.25 / std::sqrt(variance / n), 1e-14));
        QCOMPARE(*test.p, 0.0);
        QVERIFY(*test.logP < -1e5);
        const Numbers zeros(n, 0.25);
        QVERIFY(near(*stats::pairedTTest(x, zeros, {.mu = 1e9}).t, *test.t, 1e-13));
        QCOMPARE(stats::pairedTTest(x, x).why, std::string("no variation: all differences are equal"));
        x[n - 3] = notANumber;
        QCOMPARE(stats::oneSampleTTest(x).why, std::string("value 9999998 of x is not a number"));
    }

    // Blocks of a long sample may lie far apart: 5000 values about 0 and 5000 about 1e9, each ±1.
    // Sum of squares about the mean: 10000 (1 + 0.25e18).
    void longSamplesOfTwoHeaps()
    {
        Numbers x(10000);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = (i < 5000 ? 0 : 1e9) + (i % 2 == 0 ? -1 : 1);
        QVERIFY(near(*stats::describe(x).variance, 10000 * (1 + 0.25e18) / 9999, 1e-15));
        QCOMPARE(*stats::describe(x).mean, 0.5e9);
    }

    void probabilitiesBelowTheSmallestDoubleHaveTheirDecimal()
    {
        // log p = -400 ln 10
        QCOMPARE(stats::decimalOfLogarithm(-400 * std::numbers::ln10), std::string("1.0000000000e-400"));
        QCOMPARE(stats::decimalOfLogarithm(std::log(2.5) + 5000 * std::numbers::ln10).substr(0, 9), std::string("2.5000000"));
        QVERIFY(!stats::exponential(800).exists() && stats::exponential(800).decimal().ends_with("e+347"));
        QVERIFY(near(*stats::exponential(2), std::exp(2.0), 1e-15));
    }

    // Near t = 0, p = 1 - 2 f(0) t with the Cauchy density f(0) = 1/pi: log p must keep these digits.
    void logarithmOfPNearOne()
    {
        const auto tail = stats::studentTwoSided(1e-9, 1);
        QVERIFY(near(tail.logP, -2e-9 / std::numbers::pi, 1e-8));
        QVERIFY(near(stats::studentTwoSided(0.4999999, 7).p, stats::studentTwoSided(0.5000001, 7).p, 1e-6));
        QCOMPARE(stats::studentTwoSided(0, 7).p, 1.0);
        // A mean exactly at the upper bound of an equivalence test has t = -0.
        for (const double zero : {0.0, -0.0}) {
            QCOMPARE(stats::studentUpper(zero, 1).p, 0.5);
            QCOMPARE(stats::studentUpper(zero, 1).logP, -std::numbers::ln2);
        }
    }

    void nothingOneAndTwo()
    {
        for (const Numbers& x : {Numbers{}, Numbers{3}}) {
            QVERIFY(!stats::oneSampleTTest(x).p.exists() && !stats::oneSampleTTest(x).why.empty());
            QVERIFY(!stats::bcaBootstrapOfMean(x).why.empty());
        }
        QVERIFY(!stats::wilcoxonSignedRank(Numbers{}, {}).why.empty());
        QVERIFY(!stats::signFlipTest(Numbers{}, {}).why.empty());
        // Two signs are equally likely; both are as far from 0 as the observed one.
        QCOMPARE(*stats::signFlipTest(Numbers{3}, {}).p, 1.0);
        QCOMPARE(*stats::wilcoxonSignedRank(Numbers{3}, {}).pExact, 1.0);
        QVERIFY(!stats::oneWayAnova({}).why.empty() && !stats::oneWayAnova({{1}, {2}}).why.empty());
        QVERIFY(!stats::repeatedMeasuresAnova(stats::BlockTable{}).why.empty());
        QVERIFY(!stats::friedmanTest(stats::BlockTable{}).why.empty());
        QVERIFY(!stats::intraclassCorrelations(stats::BlockTable{}).why.empty());
    }

    void allEqual()
    {
        const Numbers same(10, 0.1);
        QVERIFY(!stats::oneSampleTTest(same, {.mu = 0.1}).p.exists());  // scipy answers p = .015
        QVERIFY(!stats::welchTTest(same, Numbers(4, 0.3)).p.exists());
        QVERIFY(!stats::bcaBootstrapOfMean(same).ci.low.exists());
        QVERIFY(!stats::signFlipTest(same, same).p.exists());
        QVERIFY(!stats::oneWayAnova({same, same}).f.exists() && !stats::oneWayAnova({same, Numbers(3, 0.7)}).p.exists());
        const auto table = stats::blockTableOf({{0.1, 0.1}, {0.1, 0.1}, {0.1, 0.1}}).table;
        QVERIFY(!stats::intraclassCorrelations(table).icc2.exists());
        QVERIFY(!stats::repeatedMeasuresAnova(table).f.exists());
    }

    void missingAndInfiniteAreNamed()
    {
        QCOMPARE(stats::wilcoxonSignedRank(Numbers{1, notANumber}, {}).why, std::string("value 2 of x is not a number"));
        QCOMPARE(stats::signFlipTest(Numbers{1, 2}, Numbers{1, infinity}).why, std::string("value 2 of y is infinite"));
        QCOMPARE(stats::bcaBootstrapOfMean(Numbers{-infinity, 2}).why, std::string("value 1 of x is infinite"));
        QCOMPARE(stats::oneWayAnova({{1, 2}, {3, notANumber}}).why, std::string("value 2 of group 2 is not a number"));
        QCOMPARE(stats::describe(Numbers{1, notANumber, 3}).missing, std::size_t{1});
    }

    // A power of two as a scale changes no bit of a repeated-measures analysis.
    void tablesAtEveryScale()
    {
        const std::vector<std::vector<double>> rows{{1, 2, 4}, {2, 2, 3}, {1, 3, 5}, {3, 3, 4}};
        const auto plain = stats::repeatedMeasuresAnova(stats::blockTableOf(rows).table);
        for (const int exponent : {-1000, -600, 600, 1000}) {
            auto moved = rows;
            for (auto& row : moved)
                for (double& x : row) x = std::ldexp(x, exponent);
            const auto other = stats::repeatedMeasuresAnova(stats::blockTableOf(moved).table);
            QVERIFY(*other.f == *plain.f && *other.pGg == *plain.pGg && *other.mauchly.w == *plain.mauchly.w);
        }
    }
};

QTEST_GUILESS_MAIN(ExtremesTest)
#include "extremes_test.moc"
