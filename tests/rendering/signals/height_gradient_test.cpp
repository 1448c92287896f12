#include "rendering/signals/height_gradient.h"

#include <QTest>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "tests/rendering/refusal.h"

using namespace rendering::signals;

namespace {

/// Slopes 0.03 along x and 0.04 along y, so 0.05 in total.
cv::Mat plane(int rows, int columns, double pitch, double steepness = 1)
{
    cv::Mat height(rows, columns, CV_64FC1);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) height.at<double>(i, j) = steepness * pitch * (0.03 * j + 0.04 * i) + 7;
    return height;
}

}  // namespace

class HeightGradientTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aPlaneHasItsSlopeEverywhere_data()
    {
        QTest::addColumn<double>("steepness");
        QTest::addColumn<double>("expected");
        QTest::newRow("0.05") << 1.0 << 2 * std::log10(0.05);
        QTest::newRow("flat: the least slope") << 0.0 << -4.0;
        QTest::newRow("gentler than the least slope") << 0.01 << -4.0;
        QTest::newRow("a wall: the greatest") << 100.0 << 0.0;
    }
    void aPlaneHasItsSlopeEverywhere()
    {
        QFETCH(double, steepness);
        QFETCH(double, expected);
        for (const double pitch : {0.02, 0.5}) {
            const cv::Mat gradient = heightGradient(plane(9, 7, pitch, steepness), pitch);
            QCOMPARE(gradient.type(), CV_32FC1);
            QVERIFY(cv::norm(gradient, cv::Mat(9, 7, CV_32FC1, cv::Scalar(expected)), cv::NORM_INF) < 1e-5);
        }
    }

    void thinImagesHaveNoSlopeAcross()
    {
        QCOMPARE(heightGradient(plane(1, 1, 0.1), 0.1).at<float>(0), -4.F);
        QVERIFY(std::abs(heightGradient(plane(1, 8, 0.1), 0.1).at<float>(3) - 2 * std::log10(0.03)) < 1e-6);
        QVERIFY(std::abs(heightGradient(plane(8, 1, 0.1), 0.1).at<float>(3) - 2 * std::log10(0.04)) < 1e-6);
    }

    void heightsOfANanometreAndAKilometreAreFinite()
    {
        for (const double size : {1e-6, 1e6}) {
            const cv::Mat gradient = heightGradient(plane(20, 20, 0.05) * size, 0.05);
            QVERIFY(cv::checkRange(gradient, true, nullptr, -4.0001, 0.0001));
        }
    }

    void unusableInputIsRefused()
    {
        cv::Mat broken = plane(4, 4, 0.1);
        broken.at<double>(2, 2) = std::numeric_limits<double>::quiet_NaN();
        QVERIFY(refusalOf([&] { heightGradient(broken, 0.1); }).contains("not finite"));
        QVERIFY(refusalOf([] { heightGradient({}, 0.1); }).contains("empty"));
        QVERIFY(refusalOf([] { heightGradient(plane(4, 4, 0.1), 0); }).contains("pitch"));
        QVERIFY(!refusalOf([] { heightGradient(plane(4, 4, 0.1), 0.1, {1, 0.1}); }).isEmpty());
    }
};

QTEST_GUILESS_MAIN(HeightGradientTest)
#include "height_gradient_test.moc"
