// The spectrum distance of traces, and conditional accuracy.
#include <QtTest>
#include <cmath>
#include <limits>

#include "stats/metrics/spectrum_distance.h"
#include "stats/tests/speed_accuracy.h"
#include "tests/stats/stream.h"

class SignalsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // python3 (scipy 1.10.1): x = sin(.3i) + .1((37i) mod 11), i < 300; y = 1.5 sin(.3i + 1) + .1((29i) mod 13), i < 260;
    // w = lambda v: scipy.signal.welch(v, window='hann', nperseg=64, noverlap=32, detrend='constant')[1][1:]
    // d = 10*log10(w(x)/w(y)); sqrt((d**2).mean()), d.mean()     18.90245478069682 -3.984792686581123
    void spectraAgreeWithScipy()
    {
        std::vector<double> x(300), y(260);
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = std::sin(0.3 * static_cast<double>(i)) + 0.1 * static_cast<double>(37 * i % 11);
        for (std::size_t i = 0; i < y.size(); ++i)
            y[i] = 1.5 * std::sin(0.3 * static_cast<double>(i) + 1) + 0.1 * static_cast<double>(29 * i % 13);
        const auto distance = stats::spectrumDistance(x, y);
        QVERIFY2(near(*distance.decibels, 18.90245478069682, 1e-9), qPrintable(QString::number(*distance.decibels, 'g', 17)));
        QVERIFY(near(*distance.bias, -3.984792686581123, 1e-9));
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
};

QTEST_GUILESS_MAIN(SignalsTest)
#include "signals_test.moc"
