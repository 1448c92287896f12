// The mean of participants crossed with fabrics, and the claims that rest on it.
#include "stats/claims/crossed_mean.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <limits>

#include "stats/claims/claims.h"
#include "stats/kernels/draws.h"
#include "stats/models/mixed_model.h"
#include "tests/stats/exact_numbers.h"

using stats::AnswerCube;
using stats::CrossedMean;
using stats::CrossedValues;
using stats::Generalisation;
using stats::Tail;
using stats::Verdict;

namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

/// Four participants, three fabrics: participant by participant.
const std::vector<double> twelve{1.2, 0.4, -0.3, 2.1, 1.9, 0.2, 0.3, 0.8, -1.1, 1.6, 0.1, 0.7};

CrossedValues tableOf(const std::vector<double>& values, std::size_t participants, std::size_t fabrics)
{
    AnswerCube cube(1, participants, fabrics);
    for (std::size_t i = 0; i < values.size(); ++i) cube.at(0, i / fabrics, i % fabrics) = values[i];
    return cube.valuesUnder(0);
}

bool near(const stats::Value& value, double expected, double relative = 1e-9)
{
    return value.exists() && std::abs(*value - expected) <= relative * std::abs(expected);
}

}  // namespace

class CrossedMeanTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void meanOfFabricsLikeThese()
    {
        // tests/stats/reference/mixed_models.py, crossed; V = (MSp + MSf - MSe) / 12 gives the same se and df.
        const CrossedMean mean = stats::crossedMean(tableOf(twelve, 4, 3), Generalisation::FabricsLikeThese);
        QVERIFY(near(mean.estimate, 0.658333333333333));
        QVERIFY(near(mean.se, 0.481101167462035));
        QVERIFY(near(mean.df, 2.99159844981462, 1e-6));
        QCOMPARE(mean.values, std::size_t(12));
        QVERIFY(!mean.singular);
        const stats::MeanTest test = stats::testOfMean(mean, 0, Tail::TwoSided);
        QVERIFY(near(test.t, 0.658333333333333 / 0.481101167462035));
    }

    void meanWithMissingCells()
    {
        // tests/stats/reference/mixed_models.py, crossedGap.
        auto values = twelve;
        values[4] = values[11] = gap;
        const CrossedMean mean = stats::crossedMean(tableOf(values, 4, 3), Generalisation::FabricsLikeThese);
        QCOMPARE(mean.values, std::size_t(10));
        QVERIFY(near(mean.estimate, 0.484607161815514, 1e-7));
        QVERIFY(near(mean.se, 0.52275869436226, 1e-6));
        QVERIFY(near(mean.df, 2.31577333543187, 1e-5));
        QVERIFY(near(mean.ci95.low, -1.4948486473475, 1e-5));
        QVERIFY(near(mean.ci90.high, 1.87816332266313, 1e-5));
    }

    void meanOfTheseFabricsIsTheTTestOfParticipantsMeans()
    {
        // R: t.test(c(1.3/3, 4.2/3, 0, 2.4/3)): mean 0.6583333, df 3.
        const CrossedMean mean = stats::crossedMean(tableOf(twelve, 4, 3), Generalisation::TheseFabrics);
        const auto test = stats::oneSampleTTest(std::vector<double>{1.3 / 3, 4.2 / 3, 0, 2.4 / 3});
        QVERIFY(near(mean.estimate, *test.estimate) && near(mean.se, *test.se) && near(mean.df, 3));
        QVERIFY(near(mean.ci95.low, *test.ci.low) && near(mean.ci95.high, *test.ci.high));
        const stats::MeanTest above = stats::testOfMean(mean, 0.5, Tail::Greater);
        QVERIFY(near(
            above.p,
            *stats::oneSampleTTest(std::vector<double>{1.3 / 3, 4.2 / 3, 0, 2.4 / 3}, {.mu = 0.5, .tail = Tail::Greater}).p));
    }

    void repetitionsOfACellCountOnce()
    {
        CrossedValues doubled = tableOf(twelve, 4, 3);
        const CrossedValues once = doubled;
        for (std::size_t row = 0; row < 12; ++row)
            for (const double by : {-0.25, 0.25}) {
                doubled.participant.of.push_back(once.participant.of[row]);
                doubled.fabric.of.push_back(once.fabric.of[row]);
                doubled.values.push_back(once.values[row] + by);
            }
        const CrossedMean a = stats::crossedMean(once, Generalisation::FabricsLikeThese),
                          b = stats::crossedMean(doubled, Generalisation::FabricsLikeThese);
        QVERIFY(near(b.estimate, *a.estimate) && near(b.se, *a.se, 1e-7));
        QCOMPARE(b.values, a.values);
    }

    // Tables with and without variances of zero, at several scales, against the mixed model of their rows.
    void completeTablesAreTheMixedModel_data()
    {
        QTest::addColumn<double>("participantSd");
        QTest::addColumn<double>("fabricSd");
        QTest::addColumn<int>("exponent");
        QTest::addRow("both vary") << 1.0 << 1.0 << 0;
        QTest::addRow("little variation") << 0.2 << 0.2 << 0;
        QTest::addRow("neither varies") << 0.0 << 0.0 << 0;
        QTest::addRow("participants vary") << 0.8 << 0.0 << -600;
        QTest::addRow("fabrics vary") << 0.0 << 0.8 << 600;
    }

    void completeTablesAreTheMixedModel()
    {
        QFETCH(double, participantSd);
        QFETCH(double, fabricSd);
        QFETCH(int, exponent);
        stats::Draws draws(11, 0);
        int singular = 0, limited = 0;
        for (int study = 0; study < 100; ++study) {
            const std::size_t participants = 3 + static_cast<std::size_t>(study) % 9,
                              fabrics = 2 + static_cast<std::size_t>(study) % 6;
            std::vector<double> values(participants * fabrics), ofFabric;
            for (std::size_t f = 0; f < fabrics; ++f) ofFabric.push_back(draws.normal(fabricSd));
            for (std::size_t p = 0; p < participants; ++p) {
                const double own = draws.normal(participantSd);
                for (std::size_t f = 0; f < fabrics; ++f)
                    values[p * fabrics + f] = std::ldexp(0.3 + own + ofFabric[f] + draws.normal(), exponent);
            }
            const CrossedValues rows = tableOf(values, participants, fabrics);
            const CrossedMean mean = stats::crossedMean(rows, Generalisation::FabricsLikeThese);
            const stats::MixedModel model = stats::fitMixedModel(
                {rows.values, stats::interceptOnly(values.size()), {{rows.participant, {}, ""}, {rows.fabric, {}, ""}}});
            const stats::ContrastTest& test = model.fixed.front().test;
            QVERIFY(near(mean.estimate, *test.estimate));
            // Newton's method finds a variance of nearly zero with few digits, and the closed form with all.
            const bool isClear = std::ranges::all_of(model.random, [&](const stats::RandomEffect& effect) {
                return effect.zero || *effect.sd > 0.02 * *model.residualSd;
            });
            QVERIFY(near(mean.se, *test.se, isClear ? 1e-9 : 1e-5));
            const bool noneVaries =
                std::ranges::all_of(model.random, [](const stats::RandomEffect& effect) { return effect.zero; });
            const double most = noneVaries ? stats::mostDegrees({participants, fabrics, rows.values}) : 1e9;
            QVERIFY(near(mean.df, std::min(most, *test.df), isClear ? 1e-6 : 0.1));
            limited += *mean.df < *test.df * 0.99 ? 1 : 0;
            QCOMPARE(mean.singular, model.singular);
            singular += mean.singular ? 1 : 0;
        }
        QVERIFY(participantSd > 0.5 && fabricSd > 0.5 ? singular < 50 : singular > 20);
        QVERIFY(participantSd > 0 || fabricSd > 0 || limited > 2);
    }

    void degreesOfFreedomFallAsTheMeanSquaresApproachTheResidual()
    {
        // R: x <- matrix(c(1.2,.4,-.3, 2.1,1.9,.2, .3,.8,-1.1, 1.6,.1,.7), 4, byrow = TRUE); a <- anova(lm(c(x) ~
        //   factor(row(x)) + factor(col(x)))); r <- a[["Mean Sq"]][1:2] / a[["Mean Sq"]][3]; 1.6 / (r[1]^6/3 + r[2]^6/2)
        QVERIFY(near(stats::mostDegrees({4, 3, twelve}), 9.33356388570942e-05));
        // Mean squares of 0.083 and 0.083 beside a residual of 1.79 (R, as above): the answers count.
        const stats::CrossedTable noise{3, 3, {1, -1, 0, 0, 1, -1.5, -1, 0.5, 1}};
        const CrossedMean mean = stats::crossedMean({{"participant", {"1", "2", "3"}, {0, 0, 0, 1, 1, 1, 2, 2, 2}},
                                                     {"fabric", {"1", "2", "3"}, {0, 1, 2, 0, 1, 2, 0, 1, 2}},
                                                     noise.values},
                                                    Generalisation::FabricsLikeThese);
        QCOMPARE(*mean.df, 8.0);
        QVERIFY(stats::mostDegrees(noise) > 8);
        // The same in R with the missing value left out of each mean, and of the degrees of freedom of the residual.
        stats::CrossedTable withGap{4, 3, twelve};
        withGap.values[11] = gap;
        QVERIFY(near(stats::mostDegrees(withGap), 1.58968933134271e-05));
    }

    void differencesThatAreRoundingErrorsHaveNoVariation()
    {
        // Each is 0.1 in decimals, but the doubles differ.
        const CrossedMean mean =
            stats::crossedMean(tableOf({1.1 - 1.0, 2.1 - 2.0, 3.1 - 3.0, 4.1 - 4.0}, 2, 2), Generalisation::FabricsLikeThese);
        QVERIFY2(mean.why.find("no variation") != std::string::npos, mean.why.c_str());
        const CrossedMean additive = stats::crossedMean(tableOf({1, 2, 4, 3, 4, 6}, 2, 3), Generalisation::FabricsLikeThese);
        QVERIFY2(additive.why.find("no residual variation") != std::string::npos, additive.why.c_str());
    }

    void degreesOfFreedomAreLimited()
    {
        // Both mean squares lie below the residual's, so both variances are zero and 69 answers would count.
        // R: p <- 0:9; f <- 0:6; y <- outer(p, f, function(p, f) (p^2 + 3*f^2 + 4*p*f) %% 11); a <- anova(lm(c(y) ~
        //   factor(row(y)) + factor(col(y)))); r <- a[["Mean Sq"]][1:2] / a[["Mean Sq"]][3]; 1.6 / (r[1]^6/9 + r[2]^6/6)
        std::vector<double> values;
        for (int p = 0; p < 10; ++p)
            for (int f = 0; f < 7; ++f) values.push_back((p * p + 3 * f * f + 4 * p * f) % 11);
        const CrossedMean mean = stats::crossedMean(tableOf(values, 10, 7), Generalisation::FabricsLikeThese);
        QVERIFY(mean.singular);
        QVERIFY(near(mean.df, 16.745549197813656, 1e-10));
        // A missing answer changes the mean squares little; the model of incomplete data has the limit, too.
        values[0] = gap;
        const CrossedMean withGap = stats::crossedMean(tableOf(values, 10, 7), Generalisation::FabricsLikeThese);
        QVERIFY(withGap.singular && std::abs(*withGap.df - *mean.df) < 2);
    }

    void whatCannotBeTestedSaysWhy_data()
    {
        QTest::addColumn<QList<double>>("values");
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("fabrics");
        QTest::addColumn<QString>("why");
        QTest::newRow("one participant") << QList<double>{1, 2, 3} << 1 << 3 << "one participant";
        QTest::newRow("one fabric") << QList<double>{1, 2, 3} << 3 << 1 << "one fabric";
        QTest::newRow("all equal") << QList<double>{2, 2, 2, 2} << 2 << 2 << "equal";
        QTest::newRow("nothing") << QList<double>{} << 2 << 2 << "no values";
    }
    void whatCannotBeTestedSaysWhy()
    {
        QFETCH(const QList<double>, values);
        QFETCH(const int, participants);
        QFETCH(const int, fabrics);
        QFETCH(const QString, why);
        const CrossedMean mean = stats::crossedMean(
            tableOf({values.begin(), values.end()}, static_cast<std::size_t>(participants), static_cast<std::size_t>(fabrics)),
            Generalisation::FabricsLikeThese);
        QVERIFY2(QString::fromStdString(mean.why).contains(why), mean.why.c_str());
        QVERIFY(!stats::testOfMean(mean, 0, Tail::TwoSided).p.exists() && !mean.ci95.low.exists());
    }

    void verdictsFollowTheCorrectedTests()
    {
        // Condition 1 lies 3 points above condition 0, condition 2 within 0.05 points of it; condition 3 differs by 0.2 +- 0.02.
        AnswerCube cube(4, 8, 6);
        for (std::size_t p = 0; p < 8; ++p)
            for (std::size_t f = 0; f < 6; ++f) {
                const double noise = 0.01 * static_cast<double>((p * 7 + f * 5) % 9) - 0.04;
                cube.at(0, p, f) = 5;
                cube.at(1, p, f) = 2 + 10 * noise;
                cube.at(2, p, f) = 5 + noise;
                cube.at(3, p, f) = 4.8 + noise / 2;
            }
        const std::vector<stats::ContrastPair> contrasts{{0, 1}, {0, 2}, {0, 3}};
        for (const Generalisation generalisation : {Generalisation::TheseFabrics, Generalisation::FabricsLikeThese}) {
            const auto claims = stats::contrastClaims(cube, contrasts, stats::Bounds{-0.5, 0.5}, generalisation);
            QVERIFY(claims[0].verdict == Verdict::Different);
            QVERIFY(claims[1].verdict == Verdict::Equivalent);
            QVERIFY(claims[2].verdict == Verdict::DifferentWithinBounds);
            // Holm: the smallest of three p is multiplied by 3.
            const double least = std::min({*claims[0].difference.p, *claims[1].difference.p, *claims[2].difference.p});
            const double leastAdjusted = std::min({*claims[0].pAdjusted, *claims[1].pAdjusted, *claims[2].pAdjusted});
            QVERIFY(std::abs(leastAdjusted - 3 * least) <= 1e-9 * leastAdjusted);
        }
        const auto open =
            stats::contrastClaims(cube, std::vector<stats::ContrastPair>{{0, 2}}, {}, Generalisation::FabricsLikeThese);
        QVERIFY(open[0].verdict == Verdict::NotDecided && !open[0].equivalence.p.exists());
    }

    void reversedContrastChangesTheSignOnly()
    {
        AnswerCube cube(2, 4, 3);
        for (std::size_t i = 0; i < 12; ++i) {
            cube.at(0, i / 3, i % 3) = twelve[i];
            cube.at(1, i / 3, i % 3) = 0;
        }
        const std::vector<stats::ContrastPair> both{{0, 1}, {1, 0}};
        const auto claims = stats::contrastClaims(cube, both, stats::Bounds{-0.5, 0.5}, Generalisation::FabricsLikeThese);
        QVERIFY(near(claims[0].mean.estimate, -*claims[1].mean.estimate));
        QVERIFY(near(claims[0].difference.p, *claims[1].difference.p) && near(claims[0].equivalence.p, *claims[1].equivalence.p));
    }

    void choicesAboveChance()
    {
        // Condition 0: every participant is right on 5 to 6 of 6 fabrics; condition 1: on 2.
        AnswerCube cube(2, 9, 6);
        for (std::size_t p = 0; p < 9; ++p)
            for (std::size_t f = 0; f < 6; ++f) {
                cube.at(0, p, f) = p % 2 == 0 && f == p % 6 ? 0 : 1;
                cube.at(1, p, f) = (f + p) % 3 == 0 ? 1 : 0;
            }
        const auto claims = stats::chanceClaims(cube, 1.0 / 3, Generalisation::FabricsLikeThese);
        QVERIFY(claims[0].isAbove && !claims[1].isAbove);
        QVERIFY(near(claims[0].pAdjusted, 2 * *claims[0].above.p));
        QVERIFY(near(claims[1].mean.estimate, 1.0 / 3));
    }
};

QTEST_GUILESS_MAIN(CrossedMeanTest)
#include "crossed_mean_test.moc"
