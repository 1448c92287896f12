// Surfaces whose slopes are known by formula, among them odd sizes, single rows and columns.
#include "rendering/signals/surface_integration.h"

#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "protocols/random.h"
#include "refusal.h"
#include "rendering/signals/cosine_transform.h"
#include "true_map.h"

using namespace rendering::signals;

namespace {

cv::Mat randomImage(int rows, int columns)
{
    protocols::Random random(static_cast<std::uint64_t>(rows * 1000 + columns));
    cv::Mat image(rows, columns, CV_64FC1);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) image.at<double>(i, j) = random.normal();
    return image;
}

double largestDifference(const cv::Mat& a, const cv::Mat& b)
{
    cv::Mat x, y;
    a.convertTo(x, CV_64F);
    b.convertTo(y, CV_64F);
    return cv::norm(x, y, cv::NORM_INF);
}

cv::Mat centred(const cv::Mat& values)
{
    cv::Mat result;
    values.convertTo(result, CV_64F);
    return result - cv::mean(result)[0];
}

/// Rise to the right and lower neighbour; the last column and row, which have none, hold nonsense.
Slopes forwardSlopes(const cv::Mat& height, const Pitch& pitch)
{
    Slopes slopes{cv::Mat(height.size(), CV_64FC1, 1e3), cv::Mat(height.size(), CV_64FC1, -1e3)};
    for (int i = 0; i < height.rows; ++i)
        for (int j = 0; j < height.cols; ++j) {
            if (j + 1 < height.cols)
                slopes.x.at<double>(i, j) = (height.at<double>(i, j + 1) - height.at<double>(i, j)) / pitch.x;
            if (i + 1 < height.rows)
                slopes.y.at<double>(i, j) = (height.at<double>(i + 1, j) - height.at<double>(i, j)) / pitch.y;
        }
    return slopes;
}

/// numpy.gradient: central differences, one-sided at the borders.
cv::Mat gradientAlongX(const cv::Mat& height, double pitch)
{
    cv::Mat result(height.size(), CV_64FC1);
    for (int i = 0; i < height.rows; ++i)
        for (int j = 0; j < height.cols; ++j) {
            const int a = std::max(0, j - 1), b = std::min(height.cols - 1, j + 1);
            result.at<double>(i, j) = (height.at<double>(i, b) - height.at<double>(i, a)) / ((b - a) * pitch);
        }
    return result;
}

void addSizes()
{
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    for (const auto& [rows, columns] : {std::pair{8, 8},
                                        {7, 9},
                                        {7, 8},
                                        {8, 7},
                                        {1, 12},
                                        {1, 13},
                                        {11, 1},
                                        {12, 1},
                                        {1, 1},
                                        {2, 2},
                                        {2, 3},
                                        {31, 37},
                                        {60, 81}})
        QTest::addRow("%dx%d", rows, columns) << rows << columns;
}

}  // namespace

class SurfaceIntegrationTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void cosineTransformIsTheSumOfItsDefinition_data() { addSizes(); }
    void cosineTransformIsTheSumOfItsDefinition()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        if (rows * columns > 2000) rows = columns = 25;
        const cv::Mat image = randomImage(rows, columns);
        cv::Mat expected(rows, columns, CV_64FC1);
        const auto basis = [](int k, int n, int length) {
            return std::sqrt((k == 0 ? 1.0 : 2.0) / length) * std::cos(std::numbers::pi * k * (2 * n + 1) / (2.0 * length));
        };
        for (int u = 0; u < rows; ++u)
            for (int v = 0; v < columns; ++v) {
                double sum = 0;
                for (int i = 0; i < rows; ++i)
                    for (int j = 0; j < columns; ++j) sum += basis(u, i, rows) * basis(v, j, columns) * image.at<double>(i, j);
                expected.at<double>(u, v) = sum;
            }
        const cv::Mat found = cosineTransform(image);
        QVERIFY(largestDifference(found, expected) < 1e-11);
        QVERIFY(largestDifference(inverseCosineTransform(found), image) < 1e-12);
    }

    void planeStaysAPlane_data() { addSizes(); }
    void planeStaysAPlane()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const Pitch pitch{0.05, 0.08};
        cv::Mat height(rows, columns, CV_64FC1);
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) height.at<double>(i, j) = 0.3 * j * pitch.x - 0.7 * i * pitch.y;
        const Slopes slopes{cv::Mat(rows, columns, CV_64FC1, 0.3), cv::Mat(rows, columns, CV_64FC1, -0.7)};
        QVERIFY(largestDifference(integrate(slopes, pitch), centred(height)) < 1e-12);
        QVERIFY(largestDifference(integrate(slopes, pitch, SlopeKind::Point, IntegrationQuality::Fast), centred(height)) < 2e-5);
    }

    void anySurfaceComesBackFromItsForwardSlopes_data() { addSizes(); }
    void anySurfaceComesBackFromItsForwardSlopes()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const Pitch pitch{0.05, 0.13};
        const cv::Mat height = randomImage(rows, columns);
        const cv::Mat found = integrate(forwardSlopes(height, pitch), pitch, SlopeKind::Forward);
        QVERIFY(largestDifference(found, centred(height)) < 1e-10);
    }

    void cosineSurfaceComesBackFromItsExactSlopes()
    {
        // 20 samples a wave: the mean of two neighbouring slopes is (pi/20)^2 / 3 = 0.8 % off the rise.
        const int rows = 121, columns = 100;
        const Pitch pitch{0.04, 0.05};
        const double kx = 2 * std::numbers::pi / (20 * pitch.x), ky = 2 * std::numbers::pi / (20 * pitch.y);
        cv::Mat height(rows, columns, CV_64FC1);
        Slopes slopes{height.clone(), height.clone()};
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) {
                const double x = kx * j * pitch.x, y = ky * i * pitch.y;
                height.at<double>(i, j) = 0.1 * std::cos(x) * std::sin(y);
                slopes.x.at<double>(i, j) = -0.1 * kx * std::sin(x) * std::sin(y);
                slopes.y.at<double>(i, j) = 0.1 * ky * std::cos(x) * std::cos(y);
            }
        const cv::Mat found = integrate(slopes, pitch);
        QVERIFY(cv::norm(found, centred(height)) < 0.015 * cv::norm(centred(height)));
        QVERIFY(curlResidual(slopes, pitch) < 0.01);
    }

    void realMapComesBackAsReportedElsewhere_data()
    {
        QTest::addColumn<QString>("file");
        QTest::addColumn<double>("percentOfSq");
        QTest::newRow("Dime") << "Dime.tmd" << 2.4;
        QTest::newRow("StepHeight") << "StepHeight.tmd" << 2.6;
    }
    void realMapComesBackAsReportedElsewhere()
    {
        QFETCH(QString, file);
        QFETCH(double, percentOfSq);
        const auto map = readTrueMap(sharedData("truemap_heightmaps/" + file));
        if (map.heightMm.empty()) QSKIP("the shared height maps are not there");
        cv::Mat height;
        map.heightMm.convertTo(height, CV_64F);
        const Slopes slopes{gradientAlongX(height, map.xPitchMm), gradientAlongX(height.t(), map.yPitchMm).t()};
        const cv::Mat found = integrate(slopes, {map.xPitchMm, map.yPitchMm});
        const double error = 100 * cv::norm(found, centred(height)) / cv::norm(centred(height));
        qInfo("%s: %.2f %% of Sq", qPrintable(file), error);
        QVERIFY(std::abs(error - percentOfSq) < 0.1);
    }

    void noiseIsNoSurface()
    {
        const Slopes noise{randomImage(40, 50), randomImage(50, 40).t()};
        QVERIFY(curlResidual(noise, {0.1, 0.1}) > 0.5);
        QCOMPARE(curlResidual({cv::Mat::zeros(4, 4, CV_64FC1), cv::Mat::zeros(4, 4, CV_64FC1)}, {}), 0.0);
        QCOMPARE(curlResidual({cv::Mat::ones(1, 9, CV_64FC1), cv::Mat::ones(1, 9, CV_64FC1)}, {}), 0.0);
    }

    void highPassHalvesAWaveOfTheCutOff()
    {
        const int columns = 81, k = 6;
        const Pitch pitch{0.1, 0.1};
        cv::Mat wave(5, columns, CV_64FC1);
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < columns; ++j) wave.at<double>(i, j) = std::cos(std::numbers::pi * k * (j + 0.5) / columns);
        const double wavelength = 2.0 * columns * pitch.x / k;
        QVERIFY(largestDifference(withoutLowFrequency(wave + 5, pitch, wavelength), 0.5 * wave) < 1e-12);
        QVERIFY(largestDifference(withoutLowFrequency(wave, pitch, 10 * wavelength), wave) < 1e-12);
    }

    void refusesSlopesThatAreNone()
    {
        const cv::Mat even = cv::Mat::zeros(4, 4, CV_32FC1);
        cv::Mat broken = even.clone();
        broken.at<float>(2, 1) = std::numeric_limits<float>::quiet_NaN();
        QVERIFY(refusalOf([&] { integrate({even, broken}, {}); }).contains("not finite"));
        QVERIFY(refusalOf([&] { integrate({even, cv::Mat::zeros(4, 5, CV_32FC1)}, {}); }).contains("5 x 4"));
        QVERIFY(refusalOf([&] { integrate({even, even}, {0, 1}); }).contains("pitch"));
        QVERIFY(refusalOf([&] { integrate({}, {}); }).contains("0 x 0"));
    }
};

QTEST_GUILESS_MAIN(SurfaceIntegrationTest)
#include "surface_integration_test.moc"
