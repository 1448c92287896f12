// Radial power spectra of height maps, and maps that are filtered to a wanted spectrum.
#include "rendering/models/ring_spectrum.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/random.h"

using namespace rendering::models;

namespace {

constexpr int side = 128;

cv::Mat noise(const cv::Size& size, double deviationMm, double smoothPx, std::uint64_t seed)
{
    protocols::Random random(seed);
    cv::Mat map(size, CV_32F);
    for (int row = 0; row < map.rows; ++row)
        for (int column = 0; column < map.cols; ++column)
            map.at<float>(row, column) = static_cast<float>(deviationMm * random.normal());
    if (smoothPx > 0) cv::GaussianBlur(map, map, {}, smoothPx);
    return map + 0.5;
}

cv::Mat waves(const cv::Size& size, double amplitudeMm, double periodPx)
{
    cv::Mat map(size, CV_32F);
    for (int row = 0; row < map.rows; ++row)
        for (int column = 0; column < map.cols; ++column)
            map.at<float>(row, column) =
                static_cast<float>(0.3 + amplitudeMm * std::sin(2 * std::numbers::pi * (column + 0.3 * row) / periodPx));
    return map;
}

double deviation(const cv::Mat& map)
{
    cv::Scalar mean, spread;
    cv::meanStdDev(map, mean, spread);
    return spread[0];
}

double largestDifference(const std::vector<float>& a, const std::vector<float>& b)
{
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, static_cast<double>(std::abs(a[i] - b[i])));
    return most;
}

}  // namespace

class RingSpectrumTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void whiteNoiseHasTheSquareOfItsDeviationInEveryRing()
    {
        const std::vector<float> powers = ringPowers(noise({512, 512}, 0.1, 0, 3), side);
        QCOMPARE(powers.size(), std::size_t{ringCount});
        for (std::size_t i = 8; i < powers.size(); ++i)
            QVERIFY2(std::abs(powers[i] - std::log(0.01)) < 0.15, qPrintable(QString("ring %1: %2").arg(i).arg(powers[i])));
    }

    void waveStandsOutInTheRingOfItsPeriod()
    {
        const std::vector<float> powers = ringPowers(waves({320, 240}, 0.05, 12), side);
        const auto highest = std::max_element(powers.begin() + 1, powers.end()) - powers.begin();
        const double expected = ringPlace(std::hypot(1.0, 0.3) / 12, side);
        QVERIFY2(std::abs(static_cast<double>(highest) - expected) <= 0.6, qPrintable(QString::number(highest)));
    }

    void positionsRunFromOneWavePerSideToTheFinest()
    {
        QCOMPARE(ringPlace(1.0 / side, side), 0.0);
        QCOMPARE(ringPlace(0.1 / side, side), 0.0);
        QCOMPARE(ringPlace(0.5, side), ringCount - 1.0);
        QCOMPARE(ringPlace(0.7, side), ringCount - 1.0);
        for (double frequency = 1.2 / side; frequency < 0.5; frequency *= 1.1)
            QVERIFY(ringPlace(frequency, side) > ringPlace(frequency / 1.1, side));
    }

    void slightlyOtherPeriodHardlyChangesTheRings()
    {
        // A line that jumped between rings would look like two different features to a network.
        const std::vector<float> powers = ringPowers(waves({256, 256}, 0.05, 12), side);
        const std::vector<float> nearby = ringPowers(waves({256, 256}, 0.05, 12.12), side);
        for (std::size_t i = 0; i < powers.size(); ++i)
            if (powers[i] > std::log(1e-3)) QVERIFY2(std::abs(powers[i] - nearby[i]) < 0.25, qPrintable(QString::number(i)));
    }

    void averagesAreTheWeightsOfTheRings()
    {
        const cv::Mat rows = ringAverages(side, side);
        QCOMPARE(rows.size(), cv::Size(side * side, ringCount));
        cv::Mat sums;
        cv::reduce(rows, sums, 1, cv::REDUCE_SUM);
        for (int ring = 0; ring < ringCount; ++ring) QVERIFY(std::abs(sums.at<float>(ring) - 1) < 1e-4F);
        QCOMPARE(rows.at<float>(0, 0), 0.0F);  // The mean belongs to no ring.
        // 13 cycles per window to the right lie between the middles of two rings.
        const double place = ringPlace(13.0 / side, side);
        for (int ring = 0; ring < ringCount; ++ring) QCOMPARE(rows.at<float>(ring, 13) > 0, std::abs(ring - place) < 1);
    }

    void flatMapHasTheFloor()
    {
        const std::vector<float> powers = ringPowers(cv::Mat(200, 200, CV_32F, cv::Scalar(0.2)), side);
        for (std::size_t i = 0; i < powers.size(); ++i) QVERIFY(std::abs(powers[i] - std::log(ringFloorMm2)) < 1e-3);
    }

    void smallMapIsMirrored()
    {
        for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 200), cv::Size(60, 60)})
            for (const float power : ringPowers(noise(size, 0.05, 1, 5), side)) QVERIFY(std::isfinite(power));
    }

    void narrowRingsOfSmallCropsHaveTheirNeighboursPower()
    {
        for (const cv::Size size : {cv::Size(36, 36), cv::Size(37, 300), cv::Size(33, 48), cv::Size(64, 64)}) {
            std::vector<double> sums(ringCount, 0);
            constexpr int maps = 40;
            for (int map = 0; map < maps; ++map) {
                const std::vector<float> powers = ringPowers(noise(size, 0.1, 0, 100 + static_cast<std::uint64_t>(map)), 32);
                for (std::size_t ring = 0; ring < sums.size(); ++ring)
                    sums[ring] += std::exp(static_cast<double>(powers[ring])) / maps;
            }
            for (std::size_t ring = 0; ring < sums.size(); ++ring)
                QVERIFY2(sums[ring] > 0.005 && sums[ring] < 0.02, qPrintable(QString("ring %1: %2").arg(ring).arg(sums[ring])));
        }
        for (const int crop : {32, 48, 64})
            for (int ring = 0; ring < ringCount; ++ring)
                QVERIFY(std::abs(cv::sum(ringAverages(crop, crop).row(ring))[0] - 1) < 1e-4);
    }

    void mapTakesTheSpectrumOfAnother()
    {
        const cv::Mat rough = noise({256, 256}, 0.4, 3, 7), fine = noise({256, 256}, 0.08, 1.5, 8);
        const std::vector<float> wanted = ringPowers(fine, side);
        QVERIFY(largestDifference(ringPowers(rough, side), wanted) > 1.5);
        const cv::Mat made = withRingPowers(rough, wanted, {.side = side, .mostGain = 100, .passes = 5, .zeroPercentile = 0});
        const std::vector<float> reached = ringPowers(made, side);
        // The longest waves hardly fit into a window; the blurred map contains nothing of the finest ones to amplify.
        for (std::size_t i = 1; i < 12; ++i)
            QVERIFY2(std::abs(reached[i] - wanted[i]) < 0.5,
                     qPrintable(QString("%1: %2 for %3").arg(i).arg(reached[i]).arg(wanted[i])));
        QVERIFY(std::abs(deviation(made) / deviation(fine) - 1) < 0.15);
    }

    void resultIsZeroedLikeAMeasuredMap()
    {
        const cv::Mat map = noise({256, 256}, 0.1, 2, 9);
        for (const double percentile : {1.0, 5.0}) {
            const cv::Mat made = withRingPowers(map, ringPowers(map, side), {.side = side, .zeroPercentile = percentile});
            const double zero = 100.0 * (1 - static_cast<double>(cv::countNonZero(made)) / static_cast<double>(made.total()));
            QVERIFY2(std::abs(zero - percentile) < 0.05, qPrintable(QString::number(zero)));
        }
    }

    void periodAndPlaceOfWavesStay()
    {
        const cv::Mat before = waves({200, 168}, 0.02, 9);
        std::vector<float> wanted = ringPowers(before, side);
        for (float& power : wanted) power += 1.4F;  // Twice the height.
        const cv::Mat after = withRingPowers(before, wanted, {.side = side, .mostGain = 4, .zeroPercentile = 0});
        const cv::Mat inner = before({20, 20, 160, 128}), same = after({20, 20, 160, 128});
        cv::Mat correlation;
        cv::matchTemplate(same, inner, correlation, cv::TM_CCOEFF_NORMED);
        QVERIFY2(correlation.at<float>(0, 0) > 0.995F, qPrintable(QString::number(correlation.at<float>(0, 0))));
        QVERIFY(std::abs(deviation(same) / deviation(inner) - 2) < 0.1);
    }

    void gainIsBoundedAndHeightsStayAboveZero()
    {
        const cv::Mat map = noise({140, 150}, 0.02, 2, 11);
        std::vector<float> absurd(ringCount, 12);
        const cv::Mat made = withRingPowers(map, absurd, {.side = side, .mostGain = 4});
        double low = 0, high = 0;
        cv::minMaxLoc(made, &low, &high);
        QVERIFY(low >= 0 && cv::checkRange(made));
        QVERIFY(deviation(made) < 4.2 * deviation(map));
    }

    void anySizeIsAccepted()
    {
        for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 50), cv::Size(129, 17), cv::Size(300, 17)}) {
            const cv::Mat made =
                withRingPowers(noise(size, 0.05, 0, 13), std::vector<float>(ringCount, -6), {.side = side, .passes = 3});
            QCOMPARE(made.size(), size);
            QVERIFY(cv::checkRange(made));
        }
    }
};

QTEST_APPLESS_MAIN(RingSpectrumTest)
#include "ring_spectrum_test.moc"
