// The strongest wave of synthetic and of real pictures.
#include "rendering/signals/dominant_wave.h"

#include <QTest>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "protocols/random.h"

using namespace rendering::signals;

namespace {

/// A wave with a slow change of light and some noise.
cv::Mat waves(const cv::Size& size, double periodPx, double directionDeg, double amplitude = 20)
{
    protocols::Random random(3);
    const double angle = directionDeg * std::numbers::pi / 180;
    cv::Mat picture(size, CV_8UC3);
    for (int row = 0; row < size.height; ++row)
        for (int column = 0; column < size.width; ++column) {
            const double along = column * std::cos(angle) + row * std::sin(angle);
            const double value = 120 + 60.0 * row / size.height + amplitude * std::sin(2 * std::numbers::pi * along / periodPx) +
                                 6 * random.normal();
            picture.at<cv::Vec3b>(row, column) = cv::Vec3b::all(cv::saturate_cast<unsigned char>(value));
        }
    return picture;
}

}  // namespace

class DominantWaveTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void periodAndDirectionAreFound_data()
    {
        QTest::addColumn<int>("width");
        QTest::addColumn<int>("height");
        QTest::addColumn<double>("period");
        QTest::addColumn<double>("direction");
        QTest::newRow("fine, oblique") << 512 << 512 << 4.19 << 154.0;
        QTest::newRow("along rows") << 512 << 300 << 9.3 << 0.0;
        QTest::newRow("along columns") << 300 << 512 << 25.0 << 90.0;
        QTest::newRow("small picture") << 100 << 90 << 7.0 << 30.0;
        QTest::newRow("large picture") << 3000 << 2000 << 11.5 << 61.0;
    }

    void periodAndDirectionAreFound()
    {
        QFETCH(int, width);
        QFETCH(int, height);
        QFETCH(double, period);
        QFETCH(double, direction);
        const auto wave = dominantWave(waves({width, height}, period, direction));
        QVERIFY(wave);
        QVERIFY2(std::abs(wave->periodPx / period - 1) < 0.02, qPrintable(QString::number(wave->periodPx)));
        QVERIFY2(angleBetween(*wave, {period, direction, 0}) < 2, qPrintable(QString::number(wave->directionDeg)));
    }

    void noiseConstantsAndTinyPicturesHaveNone()
    {
        QVERIFY(!dominantWave(waves({256, 256}, 8, 20, 0)));
        QVERIFY(!dominantWave(cv::Mat(200, 200, CV_8UC3, cv::Scalar::all(90))));
        QVERIFY(!dominantWave(cv::Mat(200, 200, CV_32FC1, cv::Scalar(0))));
        QVERIFY(!dominantWave(waves({31, 400}, 8, 20)));
        QVERIFY(!dominantWave(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(9))));
    }

    void anglesAreThoseOfLinesNotOfArrows()
    {
        QVERIFY(std::abs(angleBetween({5, 179, 0}, {5, 1, 0}) - 2) < 1e-9);
        QVERIFY(std::abs(angleBetween({5, 0, 0}, {5, 90, 0}) - 90) < 1e-9);
    }
};

QTEST_APPLESS_MAIN(DominantWaveTest)
#include "dominant_wave_test.moc"
