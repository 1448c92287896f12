// Power by formula against R and numerical integration, and simulated studies.
#include "stats/power/power.h"

#include <QTest>
#include <cmath>
#include <vector>

#include "stats/claims/claims.h"
#include "stats/kernels/moments.h"
#include "stats/kernels/noncentral.h"
#include "stats/power/claim_power.h"
#include "stats/power/power_groups.h"
#include "stats/power/power_plan.h"
#include "stats/tests/t_tests.h"
#include "tests/stats/exact_numbers.h"

namespace {

using Numbers = std::vector<double>;

/// Six participants, five fabrics, four conditions, three alternatives; few studies are drawn.
stats::PowerOptions smallOptions()
{
    stats::PowerOptions options;
    options.design = {6, 5, 4, 3};
    options.equivalenceBounds = {-0.4, 0.8};
    options.simulation.studies = 3;
    return options;
}

const std::vector<stats::PlannedTest>& smallPlan()
{
    static const auto planned = stats::plannedTests(smallOptions());
    return planned;
}

void compare(double value, double expected, double relative)
{
    QVERIFY2(std::fabs(value - expected) <= relative * std::fabs(expected),
             qPrintable(QString("%1, expected %2").arg(value, 0, 'g', 12).arg(expected, 0, 'g', 12)));
}

/// Where a claim is about these fabrics, the fabrics' own differences belong to what is claimed, and are left out.
stats::RatingTruth ratingsFor(stats::Generalisation generalisation)
{
    return generalisation == stats::Generalisation::TheseFabrics ? stats::ofTheseFabrics({}) : stats::RatingTruth{};
}

stats::AnswerCube cubeOf(const stats::CrossedStudy& study, stats::AnswerValues kind)
{
    stats::AnswerCube cube(kind, study.condition.levels.size(), study.participant.levels.size(), study.fabric.levels.size());
    for (std::size_t row = 0; row < study.values.size(); ++row)
        cube.at(study.condition.of[row], study.participant.of[row], study.fabric.of[row]) = study.values[row];
    return cube;
}

}  // namespace

class PowerTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void noncentralTailsAsInR()
    {
        // R's noncentral F stops at errors of 1e-9, its noncentral t cancels in the far tail.
        compare(stats::noncentralStudentUpper(2.262157, 9, 3), 0.761155307496, 1e-10);  // pt(2.262157, 9, 3, lower = FALSE)
        compare(1 - stats::noncentralStudentUpper(-2.262157, 9, 3), 1.35942266144e-06, 1e-6);  // pt(-2.262157, 9, 3)
        compare(stats::noncentralFisherUpper(2, 8, 72, 10), 0.563191728947, 1e-9);        // pf(2, 8, 72, ncp = 10, lower = FALSE)
        compare(stats::noncentralChiSquaredUpper(15.507, 8, 10), 0.587751764672, 1e-10);  // pchisq(15.507, 8, ncp = 10, ...)
        compare(stats::fisherQuantile(0.05, 8, 72), 2.069832, 1e-6);                      // qf(.95, 8, 72)
        compare(stats::chiSquaredQuantile(0.05, 8), 15.50731, 1e-6);                      // qchisq(.95, 8)
    }

    void noEffectIsTheSizeAndAHugeOneIsCertain()
    {
        compare(stats::tTestPower(10, 0), 0.05, 1e-9);
        compare(stats::noncentralFisherUpper(stats::fisherQuantile(0.05, 8, 72), 8, 72, 0), 0.05, 1e-9);
        for (const double effect : {50.0, 1e3, 1e6}) compare(stats::tTestPower(10, effect), 1, 1e-12);
        for (const double noncentrality : {9e3, 2e4, 1e9}) {
            compare(stats::noncentralFisherUpper(2, 8, 72, noncentrality), 1, 1e-12);
            compare(stats::noncentralChiSquaredUpper(15, 8, noncentrality), 1, 1e-12);
        }
        // The approximations for large noncentrality continue the exact values.
        // pf(1200, 8, 72, 9999), pchisq(10000, 8, 9999), both upper: 0.6191428, 0.511967
        compare(stats::noncentralFisherUpper(1200, 8, 72, 9999), 0.6191428, 1e-6);
        compare(stats::noncentralFisherUpper(1200, 8, 72, 10001), 0.6191428, 1e-3);
        compare(stats::noncentralChiSquaredUpper(10000, 8, 9999), 0.511967, 1e-6);
        compare(stats::noncentralChiSquaredUpper(10000, 8, 10001), 0.511967, 1e-2);
        compare(stats::noncentralStudentUpper(3000, 9, 3001), stats::noncentralStudentUpper(2998, 9, 2999), 1e-3);
        compare(stats::noncentralStudentUpper(-3000, 9, -3001), 1 - stats::noncentralStudentUpper(3000, 9, 3001), 1e-9);
    }

    void tTestsAsInR()
    {
        // power.t.test(n = 10, delta = 0.5, sd = 0.743, type = "paired", strict = TRUE) and delta = sd = 1
        compare(stats::tTestPower(10, 0.5 / 0.743), 0.476232403611, 1e-9);
        compare(stats::tTestPower(10, 1), 0.803096856633, 1e-9);
    }

    void equivalenceAsByIntegration()
    {
        // R: n <- 10; t <- qt(.95, 9); se <- .743/sqrt(n)
        //    integrate(function(s) (pnorm(.5/se - t*s) - pnorm(-.5/se + t*s)) * 2*9*s*dchisq(9*s*s, 9), 0, .5/(se*t))
        const stats::EquivalencePlan plan{10, 0.743, -0.5, 0.5, 0.05};
        compare(stats::equivalencePower(plan, 0), 0.292377992216, 1e-8);
        QCOMPARE(stats::equivalencePower(plan, 0.2), stats::equivalencePower(plan, -0.2));
        // At a bound, with the other far away, the size is alpha; beyond it, the power vanishes.
        compare(stats::equivalencePower({10, 0.1, -0.5, 0.5, 0.05}, 0.5), 0.05, 1e-6);
        QVERIFY(stats::equivalencePower({10, 0.1, -0.5, 0.5, 0.05}, 1.0) < 1e-6);
        QVERIFY(stats::equivalencePower({200, 0.743, -0.5, 0.5, 0.05}, 0) > 0.999);
    }

    void binomialAsInR()
    {
        // qbinom(.95, 70, 1/3) + 1; 1 - pbinom(30, 70, 1/3); 1 - pbinom(30, 70, .5)
        const stats::BinomialPlan plan{70, 1.0 / 3, 0.05};
        QCOMPARE(plan.critical(), 31LL);
        compare(plan.size(), 0.0366200565013, 1e-10);
        compare(stats::binomialPower(plan, 0.5), 0.859010539103, 1e-10);
        QCOMPARE(stats::BinomialPlan({2, 1.0 / 3, 0.05}).critical(), 3LL);  // two of two is 1/9: never rejects
        QCOMPARE(stats::binomialPower({2, 1.0 / 3, 0.05}, 1), 0.0);
    }

    void theSmallestDetectableEffectHasThePowerWanted()
    {
        const auto power = [](double effect) { return stats::tTestPower(10, effect); };
        const auto effect = stats::smallestDetectable(power, 10);
        compare(power(*effect), 0.8, 1e-6);
        QVERIFY(!stats::smallestDetectable(power, 0.1).exists());
        QCOMPARE(*stats::participantsNeeded([](double n) { return stats::tTestPower(n, 1); }), 10.0);  // R: 9.94
        QVERIFY(!stats::participantsNeeded([](double) { return 0.1; }).exists());
    }

    void drawsAreUniformAndNormal()
    {
        stats::Draws draws(7, 3);
        std::vector<double> normal, uniform;
        for (int i = 0; i < 200000; ++i) {
            normal.push_back(draws.normal());
            uniform.push_back(draws.uniform());
        }
        const auto z = stats::momentsOf(normal), u = stats::momentsOf(uniform);
        QVERIFY(std::fabs(z.mean()) < 0.01 && std::fabs(z.variance() - 1) < 0.015);
        QVERIFY(std::fabs(u.mean() - 0.5) < 0.003 && std::fabs(u.variance() - 1.0 / 12) < 0.001);
        QVERIFY(u.smallest > 0 && u.largest < 1);
    }

    void ratingsLieOnTheScaleAndHaveTheStatedSpread()
    {
        const stats::StudyDesign design{40, 30, 4, 3};
        stats::RatingTruth truth;
        truth.participant = truth.fabric = truth.fabricCondition = 0;
        stats::Draws draws(1, 1);
        auto study = stats::emptyStudy(design);
        stats::drawRatings(study, truth, std::vector<double>(4), draws);
        for (const double rating : study.values) {
            QVERIFY(rating >= 0 && rating <= 10);
            QVERIFY(std::fabs(rating * 10 - std::round(rating * 10)) < 1e-9);
        }
        const auto table = stats::participantMeans(study);
        std::vector<double> differences;
        for (std::size_t i = 0; i < table.blocks; ++i) {
            differences.push_back(table.at(i, 0) - table.at(i, 1));
            differences.push_back(table.at(i, 2) - table.at(i, 3));
        }
        const double variance = stats::momentsOf(differences).variance();
        const double stated = truth.sdOfDifference(design) * truth.sdOfDifference(design);
        QVERIFY(std::fabs(variance / stated - 1) < 4 * std::sqrt(2.0 / 79));
    }

    void rejectionsAreCountedAtAlphaAndUndefinedTestsApart()
    {
        stats::SimulationOptions options{.studies = 400, .seed = 2};
        std::size_t told = 0;
        options.done = [&](std::size_t studies) { told += studies; };
        const auto counts = stats::simulateTests(
            3,
            [](stats::Draws& draws, std::span<stats::Value> p) {
                const double u = draws.uniform();
                p[0] = u;
                if (u < 0.5) p[1] = 0.05;  // at alpha: rejected
            },
            options);
        std::size_t low = 0, half = 0;
        for (std::uint64_t study = 0; study < 400; ++study) {
            const double u = stats::Draws(2, study).uniform();
            low += u <= 0.05 ? 1 : 0;
            half += u < 0.5 ? 1 : 0;
        }
        QCOMPARE(counts[0].rejected, low);
        QCOMPARE(counts[1].rejected, half);
        QCOMPARE(counts[1].undefined, 400 - half);
        QCOMPARE(counts[2].undefined, std::size_t(400));
        QCOMPARE(told, std::size_t(400));
    }

    void threadsChangeNoResult()
    {
        stats::PowerOptions options;
        options.design = {5, 4, 3, 3};
        options.simulation.studies = 60;
        std::vector<std::size_t> counts[2];
        for (const unsigned threads : {1U, 3U}) {
            options.simulation.threads = threads;
            for (const auto& test : stats::plannedTests(options))
                for (const auto& point : test.points) counts[threads == 1 ? 0 : 1].push_back(point.simulated.rejected);
        }
        QVERIFY(counts[0].size() > 20);
        QCOMPARE(counts[0], counts[1]);
        // Counted by this program when all its tests agreed with R: three effects of each test in turn.
        const std::vector<std::size_t> rejected{11, 25, 47, 5,  16, 29, 3,  2, 4, 6,  27, 49, 2,  17, 39, 6,  21, 31, 5, 19,
                                                39, 12, 25, 50, 5,  15, 37, 4, 8, 23, 6,  18, 30, 4,  18, 30, 4,  13, 28};
        QCOMPARE(counts[0], rejected);
    }

    void simulationAgreesWithTheFormulaWhereThatIsExact()
    {
        stats::PowerOptions options;
        options.hasChoices = false;
        options.simulation.studies = 200;
        options.simulation.seed = 5;
        int compared = 0;
        for (const auto& test : stats::plannedTests(options)) {
            if (test.test == "repeated-measures ANOVA, Greenhouse-Geisser") continue;  // more cautious than its formula
            for (const auto& point : test.points) {
                const double power = *point.power;
                const double error = std::sqrt(std::max(0.002, power * (1 - power)) / 200);
                QVERIFY2(std::fabs(point.simulated.rate() - power) < 4 * error + 0.03,
                         qPrintable(QString("%1 at %2: %3 simulated, %4 by formula")
                                        .arg(test.test.c_str())
                                        .arg(point.effect)
                                        .arg(point.simulated.rate())
                                        .arg(power)));
                ++compared;
            }
        }
        QVERIFY(compared >= 18);
    }

    /// R, two conditions, 10 participants, 7 fabrics, variances 0.15, 0.05 and 0.85, twice each for a difference:
    ///   se <- sqrt((.15*2 + .85*2/7)/10); 1 - pt(qt(.975,9), 9, .5/se) + pt(-qt(.975,9), 9, .5/se)
    ///   msp <- 1.7+7*.3; msf <- 1.7+10*.1; mse <- 1.7; v <- msp+msf-mse; se <- sqrt(v/70)
    ///   df <- v^2/(msp^2/9+msf^2/6+mse^2/54); 1 - pt(qt(.975,df), df, .5/se) + pt(-qt(.975,df), df, .5/se)
    void powerOfClaimsIsThatOfTheirTests()
    {
        using stats::Generalisation;
        const auto variances = stats::ofDifference(stats::RatingTruth{});
        const auto these = stats::expectedError({}, variances, Generalisation::TheseFabrics),
                   alike = stats::expectedError({}, variances, Generalisation::FabricsLikeThese);
        compareNumbers({{"se, these fabrics", these.se, 0.23299294900428699, 1e-12},
                        {"df, these fabrics", these.df, 9, 0},
                        {"power, these fabrics", stats::differencePower(these, 0.5, 0.05), 0.4825593771524993, 1e-8},
                        {"se, fabrics like these", alike.se, 0.26186146828319085, 1e-12},
                        {"df, fabrics like these", alike.df, 8.019595204331571, 1e-12},
                        {"power, fabrics like these", stats::differencePower(alike, 0.5, 0.05), 0.3906671550519637, 1e-8},
                        {"one-sided", stats::abovePower(alike, 0.5, 0.05), 0.54016878990140971, 1e-8}});
        const stats::Value bounds = stats::narrowestBounds(alike, 10, 0.05);
        QVERIFY(std::fabs(stats::boundsPower(alike, -*bounds, *bounds, 0, 0.05) - 0.8) < 1e-6);
        QVERIFY(!stats::narrowestBounds(alike, 0.1, 0.05).exists());
    }

    /// 2,000 simulated studies of two conditions, analysed by the claims of the report.
    void powerOfClaimsAgreesWithSimulatedStudies_data()
    {
        QTest::addColumn<bool>("isChoice");
        QTest::addColumn<double>("effect");
        QTest::newRow("ratings, 0.5 points") << false << 0.5;
        QTest::newRow("ratings, 1 point") << false << 1.0;
        QTest::newRow("choices, 0.2") << true << 0.2;
    }

    void powerOfClaimsAgreesWithSimulatedStudies()
    {
        QFETCH(bool, isChoice);
        QFETCH(double, effect);
        const stats::StudyDesign design{10, 7, 2, 3};
        // Shares are means over people and fabrics. Their SDs of 0.5 and 0.4 draw shares towards 1/2 (Zeger, Liang and Albert
        // 1988: by 1 / sqrt(1 + 0.346 variance) in log odds).
        const auto logOddsOf = [](double share) { return std::log(share / (1 - share)) * std::sqrt(1 + 0.346 * 0.41); };
        for (const auto generalisation : {stats::Generalisation::TheseFabrics, stats::Generalisation::FabricsLikeThese}) {
            int rejected = 0;
            constexpr int studies = 2000;
            for (int s = 0; s < studies; ++s) {
                stats::Draws draws(7, static_cast<std::uint64_t>(s));
                stats::CrossedStudy study = stats::emptyStudy(design);
                if (isChoice)
                    stats::drawChoices(study, {}, Numbers{logOddsOf(0.5 + effect / 2), logOddsOf(0.5 - effect / 2)}, draws);
                else
                    stats::drawRatings(study, ratingsFor(generalisation), Numbers{effect, 0}, draws);
                const auto kind = isChoice ? stats::AnswerValues::Choices : stats::AnswerValues::Ratings;
                const auto claims =
                    stats::contrastClaims(cubeOf(study, kind), std::vector{stats::ContrastPair(0, 1)}, {}, generalisation);
                rejected += claims[0].difference.p.orElse(1) < 0.05 ? 1 : 0;
            }
            const auto variances = isChoice ? stats::ofDifference(stats::ChoiceTruth{}, 0.5 + effect / 2, 0.5 - effect / 2)
                                            : stats::ofDifference(stats::RatingTruth{});
            const double power = stats::differencePower(stats::expectedError(design, variances, generalisation), effect, 0.05);
            const double rate = static_cast<double>(rejected) / studies;
            qInfo("%s: %.3f by formula, %.3f simulated",
                  generalisation == stats::Generalisation::TheseFabrics ? "these fabrics" : "fabrics like these", power, rate);
            QVERIFY(std::fabs(rate - power) < 0.05);
        }
    }

    void smallDesignsPlanOnlyWhatTheyCan()
    {
        stats::PowerOptions options;
        options.simulation.studies = 20;
        options.design = {2, 1, 2, 2};
        for (const auto& test : stats::plannedTests(options)) {
            QVERIFY(test.test.find("mixed model") == std::string::npos);
            for (const auto& point : test.points) QCOMPARE(point.simulated.studies, std::size_t(20));
        }
        options.design = {1, 1, 1, 2};
        QVERIFY(stats::plannedTests(options).empty());
    }

    // /usr/bin/python3 tests/stats/reference/power.py
    void everyPlannedTestAsByIntegration_data()
    {
        QTest::addColumn<int>("place");
        QTest::addColumn<QString>("question");
        QTest::addColumn<QString>("effect");
        QTest::addColumn<QString>("detectable");
        QTest::addColumn<Numbers>("effects");
        QTest::addColumn<Numbers>("power");
        QTest::addColumn<double>("smallest");
        QTest::addColumn<double>("participants");  // for the largest of the effects
        QTest::newRow("paired t of participants' means")
            << 0 << "ratings"
            << "difference of two conditions, scale points"
            << "difference of two conditions, scale points" << Numbers{0.5, 1, 1.5}
            << Numbers{0.239207214292705, 0.689273116366234, 0.951459885487156} << 1.14763582563232 << 5.0;
        QTest::newRow("the same after Holm over all pairs, no other differing")
            << 1 << "ratings"
            << "difference of two conditions, scale points"
            << "difference of two conditions, scale points" << Numbers{0.5, 1, 1.5}
            << Numbers{0.0594015051487332, 0.287801935600405, 0.647140602609554} << 1.75784298432452 << 7.0;
        QTest::newRow("equivalence (TOST) of participants' means")
            << 2 << "ratings"
            << "true difference of two conditions, scale points"
            << "bounds about no difference, scale points" << Numbers{0.2, 0.35, 0.5}
            << Numbers{0.153226748207916, 0.140067577860271, 0.10699935484099} << 1.11787785605364 << 46.0;
        QTest::newRow("mixed model, t of a difference")
            << 3 << "ratings"
            << "difference of two conditions over all fabrics, scale points"
            << "difference of two conditions over all fabrics, scale points" << Numbers{0.5, 1, 1.5}
            << Numbers{0.254506375616063, 0.735160365965541, 0.972056555934974} << 1.08284169391605 << 4.0;
        QTest::newRow("repeated-measures ANOVA, Greenhouse-Geisser")
            << 4 << "ratings"
            << "range of evenly spaced condition means, scale points"
            << "range of evenly spaced condition means, scale points" << Numbers{0.5, 1, 1.5}
            << Numbers{0.19455174211289, 0.656092134630675, 0.957936136922264} << 1.16705345965649 << 5.0;
        QTest::newRow("Friedman") << 5 << "ratings"
                                  << "range of evenly spaced condition means, scale points"
                                  << "range of evenly spaced condition means, scale points" << Numbers{0.5, 1, 1.5}
                                  << Numbers{0.191390210567681, 0.651533243887078, 0.958116721466553} << 1.17049413048644 << 4.0;
        QTest::newRow("mixed model, F of condition")
            << 6 << "ratings"
            << "range of evenly spaced condition means over all fabrics, scale points"
            << "range of evenly spaced condition means over all fabrics, scale points" << Numbers{0.5, 1, 1.5}
            << Numbers{0.162935185980067, 0.549968635852306, 0.902559763986529} << 1.30699028718795 << 5.0;
        QTest::newRow("exact binomial against chance")
            << 7 << "choices"
            << "share right above chance, one condition"
            << "share right above chance, one condition" << Numbers{0.1, 1.0 / 6, 0.8 / 3}
            << Numbers{0.288653002436064, 0.572232224047184, 0.902943156179251} << 0.226149878062035 << 5.0;
        QTest::newRow("the same after Holm over the conditions, the others at chance")
            << 8 << "choices"
            << "share right above chance, one condition"
            << "share right above chance, one condition" << Numbers{0.1, 1.0 / 6, 0.8 / 3}
            << Numbers{0.0991328954416616, 0.292332355864346, 0.714504401622121} << 0.290722527719013 << 7.0;
        QTest::newRow("t of participants' shares against chance")
            << 9 << "choices"
            << "share right above chance, one condition"
            << "share right above chance, one condition" << Numbers{0.1, 1.0 / 6, 0.8 / 3}
            << Numbers{0.148012031121209, 0.317482853329473, 0.666963922454973} << 0.307741119120013 << 8.0;
        QTest::newRow("logistic mixed model, likelihood ratio")
            << 10 << "choices"
            << "range of evenly spaced log odds of a right choice, about even odds"
            << "range of evenly spaced log odds of a right choice, about even odds" << Numbers{0.5, 1, 1.5}
            << Numbers{0.118668982892341, 0.372407659682757, 0.730778582079656} << 1.61759549629442 << 7.0;
    }

    void everyPlannedTestAsByIntegration()
    {
        QFETCH(int, place);
        QFETCH(QString, question);
        QFETCH(QString, effect);
        QFETCH(QString, detectable);
        QFETCH(Numbers, effects);
        QFETCH(Numbers, power);
        QFETCH(double, smallest);
        QFETCH(double, participants);
        const auto planned = smallPlan();
        QCOMPARE(planned.size(), std::size_t{13});
        const auto& test = planned[static_cast<std::size_t>(place)];
        QCOMPARE(test.test, std::string(QTest::currentDataTag()));
        QCOMPARE(QString::fromStdString(test.question), question);
        QCOMPARE(QString::fromStdString(test.effect), effect);
        QCOMPARE(QString::fromStdString(test.detectable), detectable);
        QCOMPARE(test.points.size(), std::size_t{3});
        for (std::size_t i = 0; i < 3; ++i)
            compareNumbers({{"effect", test.points[i].effect, effects[i]}, {"power", test.points[i].power, power[i], 1e-9}});
        compareNumbers({{"smallest effect", test.smallestDetectable, smallest, 2e-8},
                        {"participants", test.points[2].participants, participants}});
    }

    void testsWithoutAFormulaAndTestsOfFabrics()
    {
        const auto planned = smallPlan();
        const auto& cochran = planned[11];
        QCOMPARE(cochran.test, std::string("Cochran's Q"));
        compareReasons({{"power", cochran.points[0].power, "no formula"},
                        {"participants", cochran.points[2].participants, "no formula"},
                        {"smallest", cochran.smallestDetectable, "no formula"}});
        const auto& fabrics = planned[12];
        QCOMPARE(fabrics.test, std::string("paired t over fabrics"));
        QCOMPARE(fabrics.question, std::string("signals"));
        QCOMPARE(fabrics.effect, std::string("mean difference of generated and measured, SDs of the differences"));
        compareNumbers({{"0.5", fabrics.points[0].power, 0.140516689990298, 1e-9},
                        {"1", fabrics.points[1].power, 0.401389917371795, 1e-9},
                        {"1.5", fabrics.points[2].power, 0.710702673925675, 1e-9},
                        {"smallest", fabrics.smallestDetectable, 1.68199696595555, 2e-8}});
        compareReasons({{"participants", fabrics.points[0].participants, "the fabrics are the unit"}});
        stats::PowerOptions options = smallOptions();
        QCOMPARE(stats::plannedStudies(options), std::size_t{8 * 3 * 3});
        options.hasChoices = false;
        QCOMPARE(stats::plannedTests(options).size(), std::size_t{8});
        options.hasChoices = true;
        options.hasRatings = false;
        QCOMPARE(stats::plannedTests(options).size(), std::size_t{6});
    }

    void formulasAtOtherLevelsAsByIntegration()
    {
        const stats::StudyDesign design{6, 5, 4, 3};
        compareNumbers(
            {{"TOST with skew bounds", stats::equivalencePower({9, 0.6, -0.5, 0.9, 0.025}, 0.1), 0.687750612549115, 1e-9},
             {"t at 1 %", stats::tTestPower(7, 0.8, 0.01), 0.159986732623294, 1e-9},
             {"binomial at 1 %", stats::binomialPower({17, 0.25, 0.01}, 0.6), 0.640507657066906},
             {"SD of a difference", stats::RatingTruth().sdOfDifference(design), 0.8},
             {"variance of a mean", stats::RatingTruth().varianceOfMean(design), 0.0633333333333333}});
        QCOMPARE((stats::BinomialPlan{30, 1.0 / 3, 0.05}.critical()), 15LL);
        QCOMPARE((stats::BinomialPlan{30, 1.0 / 3, 0.0125}.critical()), 17LL);
        compareNumbers({{"no success", stats::binomialPower({30, 1.0 / 3, 0.05}, 0), 0},
                        {"all successes", stats::binomialPower({30, 1.0 / 3, 0.05}, 1), 1}});
        const auto means = stats::evenlySpaced(4, 3);
        compareNumbers(
            {{"first", means[0], -1.5}, {"second", means[1], -0.5}, {"third", means[2], 0.5}, {"last", means[3], 1.5}});
        QCOMPARE(stats::evenlySpaced(1, 3), Numbers{0});
        QCOMPARE(stats::sumOfSquares(Numbers{-1.5, -0.5, 0.5, 1.5}), 5.0);
        compareNumbers({{"quadratic", stats::smallestDetectable([](double x) { return x * x; }, 2), std::sqrt(0.8), 1e-8},
                        {"wanted 0.5", stats::smallestDetectable([](double x) { return x * x; }, 2, 0.5), std::sqrt(0.5), 1e-8},
                        {"participants", stats::participantsNeeded([](double n) { return n / 10; }, 1000), 8},
                        {"2 suffice", stats::participantsNeeded([](double) { return 1.0; }), 2},
                        {"as many as allowed", stats::participantsNeeded([](double n) { return n / 10; }, 8), 8}});
        compareReasons({{"one fewer", stats::participantsNeeded([](double n) { return n / 10; }, 7), "more than 7"}});
    }

    // /usr/bin/python3 tests/stats/reference/power.py
    void drawnStudiesAsWrittenASecondTime()
    {
        const stats::StudyDesign design{2, 2, 3, 3};
        QCOMPARE(design.answers(), std::size_t{12});
        auto study = stats::emptyStudy(design);
        QCOMPARE(study.participant.levels, (std::vector<std::string>{"P1", "P2"}));
        QCOMPARE(study.condition.of, (std::vector<std::size_t>{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2}));
        QCOMPARE(study.fabric.of, (std::vector<std::size_t>{0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1}));
        QCOMPARE(study.participant.of, (std::vector<std::size_t>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
        QVERIFY(std::isnan(study.values[11]));
        stats::Draws ratings(11, 5);
        stats::drawRatings(study, {}, Numbers{0, 0.5, 4.5}, ratings);
        QCOMPARE(study.values, (Numbers{5.3, 7.3, 10.0, 6.4, 7.6, 9.9, 5.9, 6.2, 10.0, 3.9, 7.0, 10.0}));
        const auto means = stats::participantMeans(study);
        QCOMPARE(means.values, (Numbers{5.85, 7.45, 9.95, 4.9, 6.6, 10}));
        stats::Draws choices(11, 6);
        stats::drawChoices(study, {}, Numbers{-1, 0, 1}, choices);
        QCOMPARE(study.values, (Numbers{0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 1, 0}));
        const auto blocks = stats::answersByBlock(study);
        QCOMPARE(blocks.blocks, std::size_t{4});
        QCOMPARE(blocks.values, study.values);
        // Half steps of a scale from 1 to 7.
        stats::RatingTruth truth;
        truth.scaleMin = 1;
        truth.scaleMax = 7;
        truth.scaleStep = 0.5;
        stats::Draws again(11, 5);
        stats::drawRatings(study, truth, Numbers{-6, 0.5, 0}, again);
        QCOMPARE(study.values, (Numbers{1, 7, 6.5, 1, 7, 5.5, 1, 6, 6.5, 1, 7, 5.5}));
    }

    // The paper's design and the default assumptions, which `vis2hap power` prints.
    void defaultsOfAPlan()
    {
        const stats::StudyDesign design;
        QCOMPARE((std::vector<std::size_t>{design.participants, design.fabrics, design.conditions, design.answers()}),
                 (std::vector<std::size_t>{10, 7, 9, 630}));
        QCOMPARE(design.alternatives, 3);
        const stats::RatingTruth truth;
        QCOMPARE((Numbers{truth.centre, truth.participant, truth.fabric, truth.participantCondition, truth.fabricCondition,
                          truth.residual, truth.scaleMin, truth.scaleMax, truth.scaleStep}),
                 (Numbers{5.5, 0.5, 0.2, 0.15, 0.05, 0.85, 0, 10, 0.1}));
        const stats::ChoiceTruth choices;
        QCOMPARE((Numbers{choices.participantSd, choices.fabricSd}), (Numbers{0.5, 0.4}));
        const stats::SimulationOptions simulation;
        QCOMPARE(simulation.studies, std::size_t{10000});
        QCOMPARE(simulation.seed, std::uint64_t{1});
        QCOMPARE(simulation.alpha, 0.05);
        const stats::PowerOptions options;
        QCOMPARE(options.simulation.studies, std::size_t{1000});
        QCOMPARE(options.equivalenceBounds, (std::pair{-0.5, 0.5}));
        QVERIFY(options.hasRatings && options.hasChoices);
        QCOMPARE(stats::plannedStudies(options), std::size_t{24000});
        const stats::EquivalencePlan equivalence;
        QCOMPARE((Numbers{equivalence.n, equivalence.sd, equivalence.low, equivalence.high, equivalence.alpha}),
                 (Numbers{10, 1, -0.5, 0.5, 0.05}));
        const stats::BinomialPlan binomial;
        QCOMPARE(binomial.trials, 70LL);
        QCOMPARE((Numbers{binomial.chance, binomial.alpha}), (Numbers{1.0 / 3, 0.05}));
        compareReasons({{"participants", stats::participantsNeeded([](double n) { return n / 2000; }), "more than 1000"}});
    }
};

QTEST_GUILESS_MAIN(PowerTest)
#include "power_test.moc"
