// Psychometric functions of forced choices. Expected numbers: tests/stats/reference/psychometric_function.R.
#include "stats/models/psychometric_function.h"

#include <QTest>
#include <cmath>
#include <limits>

using stats::fitPsychometricFunction;
using stats::LevelCounts;
using stats::PsychometricFit;
using stats::PsychometricOptions;

namespace {

const std::vector<double> sixLevels{0.5, 1, 1.5, 2, 2.5, 3};

std::vector<LevelCounts> countsOf(const std::vector<double>& levels, const std::vector<double>& correct, double trials)
{
    std::vector<LevelCounts> counts;
    for (std::size_t i = 0; i < levels.size(); ++i) counts.push_back({levels[i], correct[i], trials});
    return counts;
}

bool near(const stats::Value& value, double expected, double relative = 1e-8)
{
    const bool agrees = value.exists() && std::abs(*value - expected) <= relative * std::abs(expected);
    if (!agrees) qWarning("got %.15g, expected %.15g (%s)", value.orElse(-999), expected, value.why().c_str());
    return agrees;
}

bool isRefused(const PsychometricFit& fit, const char* words)
{
    const bool says = fit.why.find(words) != std::string::npos;
    if (!says)
        qWarning("refused with: %s; mu %g sigma %g", fit.why.c_str(), fit.mu.estimate.orElse(-1), fit.sigma.estimate.orElse(-1));
    return says && !fit.mu.estimate.exists() && !fit.p.exists() && fit.threshold.estimate.why() == fit.why;
}

}  // namespace

class PsychometricFunctionTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void threeAlternativesWithoutLapses()
    {
        PsychometricOptions options;
        options.thresholdAt = 0.75;
        const auto fit = fitPsychometricFunction(countsOf(sixLevels, {14, 18, 22, 31, 37, 40}, 40), options);
        QVERIFY(near(fit.mu.estimate, 1.729804915200) && near(fit.mu.se, 0.106917077536));
        QVERIFY(near(fit.sigma.estimate, 0.589935249003) && near(fit.sigma.se, 0.109127617195));
        QVERIFY(near(fit.logLikelihood, -10.184524509736) && near(fit.deviance, 1.308442487906, 1e-9));
        QVERIFY(near(fit.df, 4) && near(fit.p, 0.859941518899));
        QVERIFY(near(fit.mu.profile.low, 1.503149220903) && near(fit.mu.profile.high, 1.941279865766));
        QVERIFY(near(fit.sigma.profile.low, 0.392503605874) && near(fit.sigma.profile.high, 0.867393277967));
        QVERIFY(near(fit.threshold.estimate, 1.917781507722) && near(fit.threshold.se, 0.097109767355));
        QVERIFY(near(fit.threshold.wald.low, 1.917781507722 - 1.959963984540 * 0.097109767355));
        QVERIFY(*fit.threshold.profile.low<*fit.threshold.estimate&& * fit.threshold.profile.high> * fit.threshold.estimate);
        QVERIFY(!fit.seLapse.exists() && *fit.lapse == 0);
    }

    void twoAlternativesWithAFixedLapseRate()
    {
        PsychometricOptions options;
        options.alternatives = 2;
        options.lapse.fixed = 0.02;
        const auto fit = fitPsychometricFunction(countsOf(sixLevels, {22, 23, 30, 33, 38, 39}, 40), options);
        QVERIFY(near(fit.mu.estimate, 1.568033913323) && near(fit.sigma.estimate, 0.677272499701));
        QVERIFY(near(fit.mu.se, 0.153029527293) && near(fit.sigma.se, 0.179893500846));
        QVERIFY(near(fit.mu.profile.low, 1.239243030357) && near(fit.mu.profile.high, 1.862270344183));
        QVERIFY(near(fit.sigma.profile.low, 0.380062856948) && near(fit.sigma.profile.high, 1.135902464388));
        QVERIFY(near(fit.threshold.estimate, *fit.mu.estimate, 1e-12));
    }

    void estimatedLapseRate()
    {
        PsychometricOptions options;
        options.lapse.estimated = true;
        const auto fit = fitPsychometricFunction(countsOf(sixLevels, {14, 15, 24, 34, 38, 38}, 40), options);
        QVERIFY(near(fit.mu.estimate, 1.5844070596, 1e-6) && near(fit.sigma.estimate, 0.4154403488, 1e-6));
        QVERIFY(near(fit.lapse, 0.04659691153, 1e-6) && near(fit.logLikelihood, -10.4866255722345, 1e-11));
        QVERIFY(near(fit.mu.se, 0.1050346005, 1e-6) && near(fit.sigma.se, 0.1355571888, 1e-6));
        QVERIFY(near(fit.seLapse, 0.0277034817, 1e-6) && near(fit.df, 3) && !fit.lapseAtLimit);
        // Another rate gives no higher likelihood.
        for (const double rate : {0.0, 0.02, 0.045, 0.048, 0.08}) {
            PsychometricOptions fixed;
            fixed.lapse.fixed = rate;
            const auto other = fitPsychometricFunction(countsOf(sixLevels, {14, 15, 24, 34, 38, 38}, 40), fixed);
            QVERIFY(*other.logLikelihood < *fit.logLikelihood);
        }
    }

    void lapseRateAtItsLimitIsSaid()
    {
        PsychometricOptions options;
        options.lapse.estimated = true;
        const auto counts = countsOf(sixLevels, {14, 18, 22, 31, 37, 40}, 40);
        const auto free = fitPsychometricFunction(counts, options);
        QVERIFY(free.lapseAtLimit && *free.lapse == 0 && !free.seLapse.exists());
        QVERIFY(near(free.mu.estimate, 1.729804915200) && near(free.df, 3));
        const auto top = fitPsychometricFunction(countsOf(sixLevels, {14, 20, 30, 32, 31, 32}, 40), options);
        QVERIFY(top.lapseAtLimit && *top.lapse == 0.1);
    }

    void equalLevelsAreAddedUpAndUnitsScale()
    {
        const auto counts = countsOf(sixLevels, {14, 18, 22, 31, 37, 40}, 40);
        std::vector<LevelCounts> single;
        for (const LevelCounts& one : counts)
            for (int i = 0; i < 40; ++i) single.push_back({one.level * 1e-9 + 5e-9, i < one.correct ? 1.0 : 0.0, 1});
        const auto fit = fitPsychometricFunction(single), whole = fitPsychometricFunction(counts);
        QCOMPARE(fit.levels, std::size_t(6));
        QVERIFY(near(fit.mu.estimate, 1.729804915200e-9 + 5e-9) && near(fit.sigma.se, 0.109127617195e-9));
        QVERIFY(near(fit.deviance, *whole.deviance, 1e-9));
    }

    void twoLevelsGiveTheirSharesWithoutATest()
    {
        const auto fit = fitPsychometricFunction(countsOf({1, 2}, {20, 30}, 40));
        QVERIFY(fit.why.empty() && std::abs(fit.fitted[0] - 0.5) < 1e-9 && *fit.df == 0);
        QVERIFY(std::abs(fit.fitted[1] - 0.75) < 1e-9 && !fit.p.exists());
    }

    void openProfileIsInfinite()
    {
        const auto fit = fitPsychometricFunction(countsOf({1, 2, 3}, {5, 6, 7}, 12));
        QVERIFY(fit.why.empty());
        QVERIFY(std::isinf(*fit.sigma.profile.high) || std::isinf(*fit.mu.profile.high));
    }

    void dataWithoutAnAnswerSayWhy()
    {
        QVERIFY(isRefused(fitPsychometricFunction({}), "no trials"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf(sixLevels, {40, 40, 40, 40, 40, 40}, 40)), "all choices are correct"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf(sixLevels, {0, 0, 0, 0, 0, 0}, 40)), "all choices are wrong"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf({2, 2}, {20, 30}, 40)), "one level only"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf(sixLevels, {39, 35, 30, 25, 20, 15}, 40)), "does not rise"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf(sixLevels, {20, 20, 20, 20, 20, 20}, 40)), "does not rise"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf({1, 2, 3, 4}, {10, 9, 40, 40}, 40)), "in one step"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf({1, 2, 3, 4}, {10, 9, 30, 40}, 40)), "in one step"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf({1, 2, 3}, {4, 4, 4}, 40)), "above chance"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf({1, 2, 3}, {4, 41, 4}, 40)), "row 2 has impossible counts"));
        QVERIFY(isRefused(fitPsychometricFunction(countsOf({1, std::nan(""), 3}, {4, 4, 4}, 40)), "row 2 has a level"));
        PsychometricOptions options;
        options.thresholdAt = 0.3;
        QVERIFY(isRefused(fitPsychometricFunction(countsOf({1, 2}, {20, 30}, 40), options), "between chance"));
        options.thresholdAt.reset();
        options.lapse.fixed = 0.9;
        QVERIFY(isRefused(fitPsychometricFunction(countsOf({1, 2}, {20, 30}, 40), options), "lapse rate must"));
    }
};

QTEST_APPLESS_MAIN(PsychometricFunctionTest)
#include "psychometric_function_test.moc"
