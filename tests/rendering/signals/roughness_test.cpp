// Roughness of surfaces with known values from their formula.
#include "rendering/signals/roughness.h"

#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/random.h"
#include "tests/rendering/refusal.h"

using namespace rendering::signals;

namespace {

cv::Mat noise(int rows, int columns, double sigmaPx)
{
    protocols::Random random(9);
    cv::Mat values(rows, columns, CV_32FC1);
    for (float& value : cv::Mat_<float>(values)) value = static_cast<float>(random.normal());
    cv::GaussianBlur(values, values, {}, sigmaPx);
    return values;
}

}  // namespace

class RoughnessTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void waveHasTheValuesOfItsFormula()
    {
        // For 0.1 cos(k x), Sq is 0.1 / sqrt 2. Along x the autocorrelation is cos(k x), which falls to 0.2 at acos(0.2) / k.
        // Sdr is the mean of sqrt(1 + slope^2) - 1 over one wave: 0.0584 by Simpson's rule.
        const Pitch pitch{0.02, 0.05};
        const double k = 2 * std::numbers::pi / 1.28;
        cv::Mat wave(100, 640, CV_64FC1);
        for (int i = 0; i < wave.rows; ++i)
            for (int j = 0; j < wave.cols; ++j) wave.at<double>(i, j) = 3 + 0.1 * std::cos(k * j * pitch.x);
        const auto found = roughnessOf(wave, pitch);
        QVERIFY(std::abs(found.sqMm - 0.1 / std::sqrt(2)) < 1e-4);
        QVERIFY2(std::abs(found.salMm - std::acos(0.2) / k) < 0.01, qPrintable(QString::number(found.salMm)));
        double area = 0;
        for (int i = 0; i < 1000; ++i)
            area += std::sqrt(1 + std::pow(0.1 * k * std::sin(2 * std::numbers::pi * i / 1000), 2)) - 1;
        QVERIFY2(std::abs(found.sdr - area / 1000) < 0.001, qPrintable(QString::number(found.sdr)));
    }

    void coarserGrainHasTheLongerAutocorrelation()
    {
        // White noise through a Gaussian of s pixels has the autocorrelation exp(-d^2 / 4 s^2), 0.2 at 2 s sqrt(ln 5).
        double before = 0;
        for (const double sigma : {1.5, 3.0, 6.0}) {
            const double length = autocorrelationLengthMm(noise(400, 500, sigma), {1, 1});
            QVERIFY2(std::abs(length / (2 * sigma * std::sqrt(std::log(5.0))) - 1) < 0.08, qPrintable(QString::number(length)));
            QVERIFY(length > before);
            before = length;
        }
    }

    void lengthsScaleWithThePitch()
    {
        const cv::Mat grain = noise(120, 150, 3);
        QVERIFY(std::abs(autocorrelationLengthMm(grain, {0.01, 0.01}) - 0.01 * autocorrelationLengthMm(grain, {1, 1})) < 1e-6);
    }

    void extremesAreDefined()
    {
        const auto flat = roughnessOf(cv::Mat::ones(20, 30, CV_32FC1), {});
        QCOMPARE(flat.sqMm, 0.0);
        QCOMPARE(flat.sdr, 0.0);
        QCOMPARE(flat.salMm, 0.0);
        QCOMPARE(roughnessOf(cv::Mat::ones(1, 1, CV_32FC1), {}).salMm, 0.0);
        const cv::Mat row = noise(1, 90, 2);
        QVERIFY(std::isfinite(roughnessOf(row, {}).salMm));
        for (const double mm : {1e-6, 1e6}) {
            const cv::Mat grain = noise(60, 60, 2) * mm;
            QVERIFY(std::isfinite(roughnessOf(grain, {}).sdr));
            QVERIFY(std::abs(autocorrelationLengthMm(grain, {}) - autocorrelationLengthMm(grain / mm, {})) < 0.01);
        }
        cv::Mat broken = cv::Mat::zeros(4, 4, CV_32FC1);
        broken.at<float>(1, 1) = std::numeric_limits<float>::quiet_NaN();
        QVERIFY(refusalOf([&] { roughnessOf(broken, {}); }).contains("not finite"));
        QVERIFY(refusalOf([&] { roughnessOf({}, {}); }).contains("empty"));
    }
};

QTEST_GUILESS_MAIN(RoughnessTest)
#include "roughness_test.moc"
