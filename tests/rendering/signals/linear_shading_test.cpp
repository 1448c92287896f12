// Relief from the shading of a known lamp, on surfaces whose relief and dye are known.
#include "rendering/signals/linear_shading.h"

#include <QTest>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "protocols/random.h"
#include "rendering/signals/shape_from_shading.h"

using namespace rendering::signals;

namespace {

constexpr int side = 320;
constexpr double pi = std::numbers::pi;

/// Noise between two wavelengths that differ by a factor of about four, deviation 1.
cv::Mat bumps(std::uint64_t seed, double sigmaPx, int sidePx = side)
{
    protocols::Random random(seed);
    cv::Mat noise(sidePx, sidePx, CV_32F), fine, coarse;
    for (auto value = noise.begin<float>(); value != noise.end<float>(); ++value) *value = static_cast<float>(random.normal());
    cv::GaussianBlur(noise, fine, {}, sigmaPx);
    cv::GaussianBlur(noise, coarse, {}, 4 * sigmaPx);
    cv::Mat result = fine - coarse;
    cv::Scalar mean, spread;
    cv::meanStdDev(result, mean, spread);
    return (result - mean[0]) / spread[0];
}

/// Logarithm of the Lambertian brightness of a surface under one lamp, whose elevation above the plane has this tangent.
cv::Mat shadingOf(const cv::Mat& height, double lightDeg, double tangent = 1)
{
    cv::Mat across, down, brightness(height.size(), CV_32F);
    cv::Sobel(height, across, CV_32F, 1, 0, 1, 0.5);
    cv::Sobel(height, down, CV_32F, 0, 1, 1, 0.5);
    const double right = std::cos(lightDeg * pi / 180), below = -std::sin(lightDeg * pi / 180);
    for (int row = 0; row < height.rows; ++row)
        for (int column = 0; column < height.cols; ++column) {
            const double p = across.at<float>(row, column), q = down.at<float>(row, column);
            const double lit = std::max(0.05, (1 - (p * right + q * below) / tangent) / std::sqrt(1 + p * p + q * q));
            brightness.at<float>(row, column) = static_cast<float>(std::log(lit));
        }
    return brightness - cv::mean(brightness)[0];
}

double correlation(const cv::Mat& a, const cv::Mat& b)
{
    cv::Mat table;
    cv::matchTemplate(a, b, table, cv::TM_CCOEFF_NORMED);
    return table.at<float>(0);
}

}  // namespace

class LinearShadingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void plainClothComesBack_data()
    {
        QTest::addColumn<double>("light");
        for (const double light : {0.0, 45.0, 90.0, 112.0, 225.0}) QTest::addRow("%g", light) << light;
    }

    void plainClothComesBack()
    {
        QFETCH(double, light);
        const cv::Mat height = 0.8 * bumps(1, 3);
        const LinearShading seen = linearShading(shadingOf(height, light), light);
        const double match = correlation(seen.relief, height);
        QVERIFY2(match > 0.7, qPrintable(QString::number(match)));
        QVERIFY2(seen.shadingShare > 0.6, qPrintable(QString::number(seen.shadingShare)));
    }

    void heightsHaveTheirUnit()
    {
        // Along the lamp everything is shading, so waves that run along it come back with their height.
        const cv::Mat height = 0.3 * bumps(1, 3);
        for (const double tangent : {0.577, 1.0, 2.0}) {
            const cv::Mat seen = tangent * linearShading(shadingOf(height, 90, tangent), 90).relief;
            const double factor = seen.dot(height) / height.dot(height);
            QVERIFY2(factor > 0.6 && factor < 1.1, qPrintable(QString("%1 at %2").arg(factor).arg(tangent)));
        }
    }

    void dyeIsToldFromShading()
    {
        // A method that takes all contrast for shading sees waves of dye.
        const cv::Mat height = bumps(1, 2), shading = shadingOf(height, 135);
        cv::Scalar mean, spread;
        cv::meanStdDev(shading, mean, spread);
        const cv::Mat contrast = shading + spread[0] * bumps(2, 5);
        const LinearShading seen = linearShading(contrast, 135);
        cv::Mat photograph;
        cv::exp(contrast - 1, photograph);
        photograph.convertTo(photograph, CV_8U, 255);
        ShadingOptions options;
        options.lightAzimuthDeg = 135;
        const double match = correlation(seen.relief, height),
                     others = correlation(shapeFromShading(photograph, options), height);
        QVERIFY2(match > 0.4 && match > others + 0.15, qPrintable(QString("%1, %2").arg(match).arg(others)));
        QVERIFY2(seen.shadingShare > 0.1 && seen.shadingShare < 0.7, qPrintable(QString::number(seen.shadingShare)));
    }

    void dyeAloneIsSeldomMoreThanChance_data()
    {
        QTest::addColumn<int>("sidePx");
        for (const int sidePx : {64, 96, 128, 256, 512}) QTest::addRow("%d px", sidePx) << sidePx;
    }

    void dyeAloneIsSeldomMoreThanChance()
    {
        QFETCH(int, sidePx);
        int above = 0, all = 0;
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            for (const double sigmaPx : {1.0, 3.0}) {
                const LinearShading seen = linearShading(bumps(seed, sigmaPx, sidePx), 100 + 13 * double(seed));
                ++all;
                above += seen.shadingShare > seen.chanceShare ? 1 : 0;
            }
        QVERIFY2(above <= 0.2 * all, qPrintable(QString("%1 of %2").arg(above).arg(all)));
    }

    void stripesOfDyeTowardsTheLampGiveNoRidges()
    {
        // Streaks of mélange yarn along the lamp. Across it they could not be told from ridges.
        cv::Mat streaks(side, side, CV_32F);
        cv::repeat(bumps(3, 2).row(0), side, 1, streaks);
        const double along = cv::norm(linearShading(streaks, 90).relief), across = cv::norm(linearShading(streaks, 0).relief);
        QVERIFY2(along < 0.1 * across, qPrintable(QString("%1, %2").arg(along).arg(across)));
    }

    void lampFromTheOtherSideTurnsHillsIntoHollows()
    {
        const cv::Mat contrast = shadingOf(bumps(1, 3), 120);
        const cv::Mat here = linearShading(contrast, 120).relief, there = linearShading(contrast, 300).relief;
        QVERIFY(cv::norm(here + there, cv::NORM_INF) < 1e-3 * cv::norm(here, cv::NORM_INF));
    }

    void uniformPictureIsFlat()
    {
        const LinearShading seen = linearShading(cv::Mat::zeros(100, 64, CV_32F), 90);
        QCOMPARE(seen.shadingShare, 0.0);
        QCOMPARE(cv::norm(seen.relief, cv::NORM_INF), 0.0);
        QCOMPARE(seen.relief.size(), cv::Size(64, 100));
    }

    void tooSmallPictureIsRefused()
    {
        QVERIFY_THROWS_EXCEPTION(protocols::Error, linearShading(cv::Mat::zeros(63, 200, CV_32F), 90));
    }
};

QTEST_GUILESS_MAIN(LinearShadingTest)
#include "linear_shading_test.moc"
