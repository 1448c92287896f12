// Spectrum distance and errors of traces, and conditional accuracy.
#include <QTest>
#include <cmath>
#include <limits>

#include "stats/metrics/spectrum_distance.h"
#include "stats/metrics/trace_error.h"
#include "stats/tests/speed_accuracy.h"
#include "tests/stats/exact_numbers.h"
#include "tests/stats/stream.h"

namespace {

/// amplitude sin(0.3 i + phase) + 0.1 (factor i mod modulus), i < n
std::vector<double> wave(std::size_t n, double phase, std::size_t factor, std::size_t modulus, double amplitude)
{
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i)
        x[i] = amplitude * std::sin(0.3 * static_cast<double>(i) + phase) + 0.1 * static_cast<double>(factor * i % modulus);
    return x;
}

}  // namespace

class SignalsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // /usr/bin/python3 tests/stats/reference/signals.py
    void spectraAgreeWithScipy()
    {
        const auto distance = stats::spectrumDistance(wave(300, 0, 37, 11, 1), wave(260, 1, 29, 13, 1.5));
        compareNumbers(
            {{"distance", distance.decibels, 18.9024547806968, 1e-11}, {"bias", distance.bias, -3.98479268658112, 1e-11}});
        QCOMPARE(distance.frequencies, std::size_t{32});
    }

    // Twice the amplitude: 20 log10(2) at every frequency.
    void amplitudeTwiceAsLargeIsSixDecibels()
    {
        const auto truth = Stream(4).numbers(500);
        auto twice = truth;
        for (double& x : twice) x = 2 * x + 7;
        const auto distance = stats::spectrumDistance(twice, truth);
        QVERIFY(near(*distance.decibels, 20 * std::log10(2), 1e-9) && near(*distance.bias, 20 * std::log10(2), 1e-9));
        QCOMPARE(*stats::spectrumDistance(truth, truth).decibels, 0.0);
    }

    void spectraThatDoNotExistSayWhy()
    {
        const auto truth = Stream(4).numbers(100);
        QVERIFY(
            QString::fromStdString(stats::spectrumDistance(Stream(1).numbers(63), truth).why).contains("shorter than a segment"));
        QVERIFY(QString::fromStdString(stats::spectrumDistance(std::vector<double>(90, 0.5), truth).why).contains("no power"));
        auto broken = truth;
        broken[5] = std::numeric_limits<double>::quiet_NaN();
        QVERIFY(!stats::spectrumDistance(broken, truth).decibels.exists());
    }

    void accuracyIsTakenFromFastToSlow()
    {
        const std::vector<double> seconds{9, 1, 2, 8, 3, 4, 5, 6, 7, 10};
        const std::vector<bool> correct{true, false, false, true, false, true, true, false, true, true};
        const auto accuracy = stats::conditionalAccuracy(seconds, correct, 2);
        QCOMPARE(accuracy.bins.size(), std::size_t{2});
        QCOMPARE(accuracy.bins[0].n, std::size_t{5});
        QCOMPARE(*accuracy.bins[0].meanSeconds, 3.0);
        QCOMPARE(*accuracy.bins[0].proportionCorrect, 0.4);
        QCOMPARE(*accuracy.bins[1].proportionCorrect, 0.8);
    }

    void equalTimesShareABin()
    {
        const std::vector<double> seconds{2, 2, 2, 2, 2, 7};
        const std::vector<bool> correct{true, false, true, false, true, true};
        const auto accuracy = stats::conditionalAccuracy(seconds, correct, 3);
        QCOMPARE(accuracy.bins[0].n, std::size_t{5});
        QCOMPARE(accuracy.bins[1].n, std::size_t{0});
        QVERIFY(!accuracy.bins[1].proportionCorrect.exists());
        QCOMPARE(accuracy.bins[2].n, std::size_t{1});
        QVERIFY(!stats::conditionalAccuracy(std::vector<double>{}, {}, 3).why.empty());
        QVERIFY(!stats::conditionalAccuracy(seconds, {true}, 3).why.empty());
    }

    // /usr/bin/python3 tests/stats/reference/signals.py
    void oddSegmentsAsInScipy()
    {
        const auto distance = stats::spectrumDistance(wave(300, 0, 37, 11, 1), wave(260, 1, 29, 13, 1.5), 17);
        compareNumbers(
            {{"distance", distance.decibels, 5.99553805281287, 1e-11}, {"bias", distance.bias, -2.26960731830336, 1e-11}});
        QCOMPARE(distance.frequencies, std::size_t{8});
        const auto powers = stats::powerSpectrum(wave(30, 0, 37, 11, 1), 9);
        QCOMPARE(powers.size(), std::size_t{5});
        compareNumbers({{"frequency 0", powers[0], 2.75469804143487},
                        {"frequency 1", powers[1], 6.94576817021845},
                        {"frequency 2", powers[2], 1.82906439028839},
                        {"frequency 3", powers[3], 3.40358258907564},
                        {"frequency 4", powers[4], 2.2738117529522}});
        QVERIFY(stats::powerSpectrum(std::vector<double>(8, 1.0), 9).empty());
        QVERIFY(stats::powerSpectrum(std::vector<double>(8, 1.0), 3).empty());
        QCOMPARE(stats::powerSpectrum(std::vector<double>{1, 2, 4, 3}, 4).size(), std::size_t{3});
        compareReasons({{"segment of 3", stats::spectrumDistance(powers, powers, 3).bias, "at least 4 values"}});
    }

    void traceErrorsAsInNumpy()
    {
        const std::vector<double> generated{0.31, 0.42, 0.28, 0.55, 0.47, 0.36};
        const std::vector<double> truth{0.30, 0.45, 0.33, 0.41, 0.49, 0.30};
        const auto error = stats::traceError(generated, truth);
        QCOMPARE(error.n, std::size_t{6});
        compareNumbers({{"mean absolute error", error.mae, 0.0516666666666667},
                        {"mean of the truth", error.meanTruth, 0.38},
                        {"their ratio", error.maeOverMean, 0.135964912280702},
                        {"root mean square", error.rmse, 0.0672061505121865},
                        {"bias", error.bias, 0.0183333333333333},
                        {"largest", error.maxAbs, 0.14}});
        compareReasons(
            {{"lengths", stats::traceError(generated, std::vector<double>{1}).mae, "differ in length: 6 and 1"},
             {"nothing", stats::traceError({}, {}).rmse, "empty"},
             {"mean 0", stats::traceError(std::vector<double>{1, 2}, std::vector<double>{1, -1}).maeOverMean, "not positive"}});
    }

    // Wilson intervals of 2 of 5 and 4 of 5: R: prop.test(2, 5, correct = FALSE)$conf.int and (4, 5)
    void accuracyHasItsIntervals()
    {
        const std::vector<double> seconds{9, 1, 2, 8, 3, 4, 5, 6, 7, 10};
        const std::vector<bool> correct{true, false, false, true, false, true, true, false, true, true};
        const auto bins = stats::conditionalAccuracy(seconds, correct, 2).bins;
        compareNumbers({{"fast", bins[0].meanSeconds, 3},
                        {"slow", bins[1].meanSeconds, 8},
                        {"low of the fast", bins[0].ci95.low, 0.117620774232648},
                        {"high of the fast", bins[0].ci95.high, 0.769275718723987},
                        {"low of the slow", bins[1].ci95.low, 0.375534629762525},
                        {"high of the slow", bins[1].ci95.high, 0.963775891367570}});
        QCOMPARE(stats::conditionalAccuracy(seconds, correct).bins.size(), std::size_t{5});
        QCOMPARE(stats::conditionalAccuracy(seconds, correct, 1).bins[0].n, std::size_t{10});
        compareNumbers({{"third bin of three", stats::conditionalAccuracy(seconds, correct, 3).bins[2].meanSeconds, 9}});
        QCOMPARE(stats::conditionalAccuracy(seconds, correct, 0).why, std::string("needs at least 1 bin"));
    }
};

QTEST_GUILESS_MAIN(SignalsTest)
#include "signals_test.moc"
