// The mean of participants crossed with fabrics, and the claims that rest on it.
#include "stats/claims/crossed_mean.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <limits>

#include "stats/claims/claims.h"
#include "stats/claims/two_condition_model.h"
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
    Q_ASSERT(values.size() == participants * fabrics);
    std::vector<std::string> ofParticipants, ofFabrics;
    for (std::size_t i = 0; i < values.size(); ++i) {
        ofParticipants.push_back(std::to_string(i / fabrics + 1));
        ofFabrics.push_back(std::to_string(i % fabrics + 1));
    }
    return {stats::factorOf("participant", ofParticipants), stats::factorOf("fabric", ofFabrics), values};
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
        //   factor(row(x)) + factor(col(x)))); r <- a[["Mean Sq"]][1:2] / a[["Mean Sq"]][3]; 1.2 / (r[1]^6/3 + r[2]^6/2)
        QVERIFY(near(stats::mostDegrees({4, 3, twelve}), 7.000172914282065e-05));
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
        QVERIFY(near(stats::mostDegrees(withGap), 1.1922669985070326e-05));
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

    /// Ratings of which each is 0.3 below another one, in decimals and as means of three repetitions.
    void ratingsAtOneDistanceAreNoEvidence()
    {
        stats::Draws draws(5, 1);
        for (int study = 0; study < 200; ++study)
            for (const double repetitions : {1.0, 3.0}) {
                std::vector<double> a, b;
                for (int cell = 0; cell < 12; ++cell) {
                    double sumA = 0, sumB = 0;
                    for (int i = 0; i < static_cast<int>(repetitions); ++i) {
                        const auto tenths = static_cast<int>(3 + 97 * draws.uniform());
                        sumA += tenths / 10.0;
                        sumB += (tenths - 3) / 10.0;
                    }
                    a.push_back(sumA / repetitions);
                    b.push_back(sumB / repetitions);
                }
                stats::StudentQuantiles quantiles;
                for (const Generalisation to : {Generalisation::FabricsLikeThese, Generalisation::TheseFabrics}) {
                    const CrossedMean mean =
                        stats::differenceOfRatings({4, 3, a}, {4, 3, b}, to, stats::Degrees::Limited, quantiles);
                    QVERIFY2(!mean.why.empty() && !mean.se.exists(), mean.se.decimal().c_str());
                    QVERIFY(near(*mean.estimate, 0.3, 1e-13));
                }
            }
    }

    void degreesOfFreedomAreLimited()
    {
        // Both mean squares lie below the residual's, so both variances are zero and 69 answers would count.
        // R: p <- 0:9; f <- 0:6; y <- outer(p, f, function(p, f) (p^2 + 3*f^2 + 4*p*f) %% 11); a <- anova(lm(c(y) ~
        //   factor(row(y)) + factor(col(y)))); r <- a[["Mean Sq"]][1:2] / a[["Mean Sq"]][3]; 1.2 / (r[1]^6/9 + r[2]^6/6)
        std::vector<double> values;
        for (int p = 0; p < 10; ++p)
            for (int f = 0; f < 7; ++f) values.push_back((p * p + 3 * f * f + 4 * p * f) % 11);
        const CrossedMean mean = stats::crossedMean(tableOf(values, 10, 7), Generalisation::FabricsLikeThese);
        QVERIFY(mean.singular);
        QVERIFY(near(mean.df, 12.55916189836024, 1e-10));
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
        AnswerCube cube(stats::AnswerValues::Ratings, 4, 8, 6);
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

    // tests/stats/reference/two_conditions.R, seed 8: lmerTest's se is 1.443665 and its df 8.2418 (calibration_test has more).
    void ratingsWithoutGapsAreTestedByTheModelOfTheTwoConditions()
    {
        const std::vector<double> a{0.2, 1.6, 2.9, -2.7, -1, 0.8, -2.4, -2.9, -2.1, -0.5, -0.2, 3.5},
            b{1.6, -0.1, 0.4, -1.9, 0.5, -2.2, 3.9, 2.2, 2.8, 1.1, 0.8, 0.3};
        const auto cubeOf = [&](stats::AnswerValues kind, double unit) {
            AnswerCube cube(kind, 2, 5, 3);  // the last participant has no answers
            for (std::size_t i = 0; i < 12; ++i) {
                cube.at(0, i / 3, i % 3) = unit * a[i];
                cube.at(1, i / 3, i % 3) = unit * b[i];
            }
            return cube;
        };
        stats::StudentQuantiles quantiles;
        const auto meanOf = [&](const AnswerCube& cube) {
            return stats::differenceOf(cube, {0, 1}, Generalisation::FabricsLikeThese, stats::Degrees::Limited, quantiles);
        };
        for (const double unit : {1.0, 1e-300, 1e300}) {
            const auto mean = meanOf(cubeOf(stats::AnswerValues::Ratings, unit));
            QVERIFY(std::abs(*mean.se / unit - 1.443665) < 1e-5 && std::abs(*mean.df - 8.2418) < 1e-3);
            QCOMPARE(mean.participants, std::size_t(4));
            QVERIFY(near(mean.estimate, unit * (-12.2 / 12)));
        }
        AnswerCube one = cubeOf(stats::AnswerValues::Ratings, 1);
        const auto ofDifferences = [&](const AnswerCube& cube) {
            return stats::crossedMean(cube.differences(0, 1), Generalisation::FabricsLikeThese, quantiles);
        };
        QVERIFY(*meanOf(one).se != *ofDifferences(one).se);
        const AnswerCube choices = cubeOf(stats::AnswerValues::Choices, 1);
        QCOMPARE(*meanOf(choices).se, *ofDifferences(choices).se);
        one.at(1, 2, 1) = std::nan("");
        QCOMPARE(*meanOf(one).se, *ofDifferences(one).se);
        QCOMPARE(*meanOf(one).df, *ofDifferences(one).df);
    }

    /// Conditions whose cells have unequal repetitions are compared on those that both have; no other contrast changes.
    void pairsAreComparedOnTheMeansThatAreComparable()
    {
        AnswerCube cube(stats::AnswerValues::Ratings, 3, 4, 3);
        for (std::size_t i = 0; i < 12; ++i)
            for (const std::size_t c : {0U, 1U, 2U}) cube.at(c, i / 3, i % 3) = twelve[(i + 5 * c) % 12];
        const AnswerCube whole = cube;
        stats::CrossedTable ofA = cube.tableUnder(0), ofB = cube.tableUnder(1);
        cube.setComparable(0, 1, ofA, ofB);
        QVERIFY(!cube.comparesOtherMeans());  // they are the means of the cells
        ofA.values[4] += 2;
        ofB.values[7] = gap;
        cube.setComparable(0, 1, ofA, ofB);
        QVERIFY(cube.comparesOtherMeans(1, 0) && !cube.comparesOtherMeans(0, 2));
        const auto differences = cube.differences(0, 1), reversed = cube.differences(1, 0);
        QCOMPARE(differences.values[4], whole.differences(0, 1).values[4] + 2);
        QCOMPARE(reversed.values[4], -differences.values[4]);
        QVERIFY(std::isnan(differences.values[7]) && std::isnan(reversed.values[7]));
        QVERIFY(std::isnan(cube.withoutFabric(1).differences(0, 1).values[4]));
        QVERIFY(std::isnan(cube.withoutParticipant(1).differences(0, 1).values[4]));
        QVERIFY(stats::degreesOf(cube) == stats::Degrees::Limited);
        // The sums differ with the repetitions that are left, so the model is that of the differences.
        ofB = cube.tableUnder(1);
        cube.setComparable(0, 1, ofA, ofB);
        stats::StudentQuantiles quantiles;
        const auto mean = stats::differenceOf(cube, {0, 1}, Generalisation::FabricsLikeThese, stats::Degrees::Limited, quantiles);
        const auto ofDifferences = stats::crossedMean(cube.differences(0, 1), Generalisation::FabricsLikeThese, quantiles);
        QCOMPARE(*mean.se, *ofDifferences.se);
        const auto other =
            stats::differenceOf(cube, {0, 2}, Generalisation::FabricsLikeThese, stats::Degrees::Limited, quantiles);
        QCOMPARE(*other.se,
                 *stats::differenceOf(whole, {0, 2}, Generalisation::FabricsLikeThese, stats::Degrees::Limited, quantiles).se);
    }

    /// 4.3 - 3.3 and 2.3 - 1.3 differ in the last digit only: they have no variation to test.
    void comparableMeansThatAreEqualButForRoundingHaveNoTest()
    {
        AnswerCube cube(stats::AnswerValues::Ratings, 2, 3, 2);
        for (std::size_t i = 0; i < 6; ++i) cube.at(0, i / 2, i % 2) = cube.at(1, i / 2, i % 2) = 5;
        stats::CrossedTable ofA{3, 2, {4.3, 2.3, 4.3, 2.3, 4.3, 2.3}}, ofB{3, 2, {3.3, 1.3, 3.3, 1.3, 3.3, 1.3}};
        QVERIFY(4.3 - 3.3 != 2.3 - 1.3);
        cube.setComparable(0, 1, ofA, ofB);
        stats::StudentQuantiles quantiles;
        for (const Generalisation generalisation : {Generalisation::TheseFabrics, Generalisation::FabricsLikeThese})
            QVERIFY(!stats::differenceOf(cube, {0, 1}, generalisation, stats::Degrees::Limited, quantiles).why.empty());
    }

    void degreesOfRatingsAreLimitedWhereNothingVaries()
    {
        // tests/stats/reference/two_conditions.R, seed 12: lmerTest's df is 17. The mean squares of the differences are 0.886
        // (participants) and 0.451 (fabrics) of the residual's: 1.2 / (0.886^6 / 3 + 0.451^6 / 2).
        const std::vector<double> a{-2.3, 1.4, -0.5, -0.8, -1.2, 1.2, -2, -1.6, -0.5, -1.6, -2.1, -2},
            b{-0.4, 0.3, 0.9, 0.6, 2.4, 2.3, 0, -0.9, 0.4, 1.1, 0.1, -0.5};
        AnswerCube cube(stats::AnswerValues::Ratings, 2, 4, 3);
        for (std::size_t i = 0; i < 12; ++i) {
            cube.at(0, i / 3, i % 3) = a[i];
            cube.at(1, i / 3, i % 3) = b[i];
        }
        stats::StudentQuantiles quantiles;
        const auto limited =
            stats::differenceOf(cube, {0, 1}, Generalisation::FabricsLikeThese, stats::Degrees::Limited, quantiles);
        QVERIFY(limited.singular);
        QVERIFY(std::abs(*limited.df - 7.250527) < 1e-5 && std::abs(*limited.se - 0.393643) < 1e-4);
    }

    // R: anova(lm(y ~ c * (p + f))) has p = .95 for c:p and .72 for c:f; .0034 for c:p with 4 points of the interaction.
    void degreesAreLimitedWhereAllConditionsShowAnInteraction()
    {
        const auto cubeOf = [](double ofParticipants, double unit) {
            AnswerCube cube(stats::AnswerValues::Ratings, 3, 5, 4);
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t p = 0; p < 5; ++p)
                    for (std::size_t f = 0; f < 4; ++f) {
                        const auto noise = static_cast<double>((7 * c + 3 * p * p + 5 * f * f + 4 * p * f * (c + 1)) % 11);
                        cube.at(c, p, f) = unit * (noise + ofParticipants * static_cast<double>((c * p) % 3));
                    }
            return cube;
        };
        for (const double unit : {1.0, 1e-300, 1e300}) {
            QVERIFY(stats::degreesOf(cubeOf(0, unit)) == stats::Degrees::Satterthwaite);
            QVERIFY(stats::degreesOf(cubeOf(4, unit)) == stats::Degrees::Limited);
        }
        AnswerCube gaps = cubeOf(0, 1);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t f = 0; f < 4; ++f) gaps.at(c, 4, f) = gap;
        QVERIFY(stats::degreesOf(gaps) == stats::Degrees::Satterthwaite);  // a participant without any answer is left out
        gaps.at(1, 2, 3) = gap;
        QVERIFY(stats::degreesOf(gaps) == stats::Degrees::Limited);
    }

    void reversedContrastChangesTheSignOnly()
    {
        AnswerCube cube(stats::AnswerValues::Ratings, 2, 4, 3);
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
        AnswerCube cube(stats::AnswerValues::Choices, 2, 9, 6);
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
