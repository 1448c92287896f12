// Power by formula against R, and the simulation that stands beside it.
#include "stats/power/power.h"

#include <QtTest>
#include <cmath>
#include <vector>

#include "stats/kernels/moments.h"
#include "stats/kernels/noncentral.h"
#include "stats/power/power_plan.h"
#include "stats/tests/t_tests.h"

namespace {

void compare(double value, double expected, double relative)
{
    QVERIFY2(std::fabs(value - expected) <= relative * std::fabs(expected),
             qPrintable(QString("%1, expected %2").arg(value, 0, 'g', 12).arg(expected, 0, 'g', 12)));
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
        // The approximations take over without a step.
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
        // At a bound, the other being far away, the size is alpha; and no sample shows what is not so.
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
};

QTEST_GUILESS_MAIN(PowerTest)
#include "power_test.moc"
