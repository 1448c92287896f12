#include "rendering/signals/shape_from_shading.h"

#include <QTest>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/random.h"
#include "rendering/images/image_png.h"
#include "rendering/images/true_map.h"
#include "rendering/signals/surface_integration.h"
#include "tests/rendering/refusal.h"
#include "tests/rendering/shared_data.h"

using namespace rendering::signals;

namespace {

/// Waves of random direction and phase, 6 to 30 pixels long; slopes about 0.2.
cv::Mat randomRelief(int rows, int columns)
{
    protocols::Random random(21);
    cv::Mat relief = cv::Mat::zeros(rows, columns, CV_64FC1);
    for (int wave = 0; wave < 60; ++wave) {
        const double k = 2 * std::numbers::pi / random.uniform(6, 30), angle = random.uniform(0, std::numbers::pi);
        const double kx = k * std::cos(angle), ky = k * std::sin(angle), phase = random.uniform(0, 2 * std::numbers::pi);
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) relief.at<double>(i, j) += 0.04 / k * std::cos(kx * j + ky * i + phase);
    }
    return relief;
}

/// A matt surface in distant light, with camera noise.
cv::Mat lambertian(const cv::Mat& relief, double azimuthDeg, double slantDeg)
{
    const double a = azimuthDeg * std::numbers::pi / 180, s = slantDeg * std::numbers::pi / 180;
    protocols::Random random(4);
    cv::Mat photograph(relief.size(), CV_8UC3);
    const auto height = [&](int i, int j) {
        return relief.at<double>(std::clamp(i, 0, relief.rows - 1), std::clamp(j, 0, relief.cols - 1));
    };
    for (int i = 0; i < relief.rows; ++i)
        for (int j = 0; j < relief.cols; ++j) {
            const double p = (height(i, j + 1) - height(i, j - 1)) / 2, q = (height(i + 1, j) - height(i - 1, j)) / 2;
            const double light = (std::cos(s) - std::sin(s) * (p * std::cos(a) - q * std::sin(a))) / std::sqrt(1 + p * p + q * q);
            const auto level = cv::saturate_cast<unsigned char>(180 * std::max(0.0, light) + 2 * random.normal());
            photograph.at<cv::Vec3b>(i, j) = {level, level, level};
        }
    return photograph;
}

double correlation(const cv::Mat& a, const cv::Mat& b)
{
    cv::Mat x, y;
    a.convertTo(x, CV_64F);
    b.convertTo(y, CV_64F);
    x -= cv::mean(x)[0];
    y -= cv::mean(y)[0];
    return x.dot(y) / (cv::norm(x) * cv::norm(y));
}

/// Band between Gaussians of 1.5 and 40 pixels.
cv::Mat inBand(const cv::Mat& image)
{
    cv::Mat values, fine, coarse;
    image.convertTo(values, CV_64F);
    cv::GaussianBlur(values, fine, {}, 1.5, 0, cv::BORDER_REFLECT);
    cv::GaussianBlur(values, coarse, {}, 40, 0, cv::BORDER_REFLECT);
    return fine - coarse;
}

}  // namespace

class ShapeFromShadingTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void reliefComesBackFromItsPhotograph_data()
    {
        QTest::addColumn<double>("azimuth");
        QTest::addColumn<bool>("fast");
        for (const double azimuth : {20.0, 60.0, 90.0, 135.0}) QTest::addRow("light from %.0f", azimuth) << azimuth << false;
        QTest::newRow("fast") << 60.0 << true;
    }
    void reliefComesBackFromItsPhotograph()
    {
        QFETCH(double, azimuth);
        QFETCH(bool, fast);
        const cv::Mat relief = randomRelief(200, 231), photograph = lambertian(relief, azimuth, 45);
        const auto light = estimateLight(photograph);
        QVERIFY2(std::abs(light.azimuthDeg - azimuth) < 12, qPrintable(QString::number(light.azimuthDeg)));
        ShadingOptions options;
        if (fast) options.quality = ShadingQuality::Fast;
        const cv::Mat found = shapeFromShading(photograph, options);
        QCOMPARE(found.type(), CV_32FC1);
        QCOMPARE(found.size(), relief.size());
        const double r = correlation(found, relief);
        qInfo("correlation %.3f", r);
        QVERIFY(r >= 0.6);
    }

    void heightIsInPixels()
    {
        // One wave of 16 pixels and 0.5 pixels height, lit along it at 45 degrees: the amplitude is correct within 15 %.
        cv::Mat relief(128, 128, CV_64FC1);
        for (int i = 0; i < 128; ++i)
            for (int j = 0; j < 128; ++j) relief.at<double>(i, j) = 0.25 * std::cos(2 * std::numbers::pi * j / 16);
        const cv::Mat found = shapeFromShading(lambertian(relief, 180, 45), {.lightAzimuthDeg = 180.0});
        cv::Mat inner;  // Mean of the rows, without the streaks that noise leaves along the light.
        cv::reduce(found(cv::Rect(32, 32, 64, 64)), inner, 0, cv::REDUCE_AVG);
        double low = 0, high = 0;
        cv::minMaxLoc(inner, &low, &high);
        QVERIFY2(std::abs((high - low) - 0.5) < 0.1, qPrintable(QString::number(high - low)));
    }

    void horizontalLightIsAssumedFromTheLeft()
    {
        const auto light = estimateLight(lambertian(randomRelief(160, 160), 180, 45));
        QVERIFY2(std::abs(light.azimuthDeg - 180) < 10, qPrintable(QString::number(light.azimuthDeg)));
    }

    void unevenLightGivesNoRelief()
    {
        cv::Mat photograph = lambertian(randomRelief(200, 200), 90, 45), even = photograph.clone();
        for (int i = 0; i < 200; ++i)
            for (int j = 0; j < 200; ++j) photograph.at<cv::Vec3b>(i, j) *= 0.4 + 0.003 * j;
        QVERIFY(correlation(shapeFromShading(photograph), shapeFromShading(even)) > 0.95);
    }

    void evenPhotographGivesEvenRelief_data()
    {
        QTest::addColumn<int>("level");
        QTest::addColumn<int>("size");
        QTest::newRow("black") << 0 << 40;
        QTest::newRow("grey") << 128 << 41;
        QTest::newRow("white") << 255 << 64;
        QTest::newRow("one pixel") << 100 << 1;
        QTest::newRow("three pixels") << 100 << 3;
    }
    void evenPhotographGivesEvenRelief()
    {
        QFETCH(int, level);
        QFETCH(int, size);
        const cv::Mat photograph(size, size, CV_8UC3, cv::Scalar::all(level));
        for (const auto quality : {ShadingQuality::Accurate, ShadingQuality::Fast}) {
            const cv::Mat relief = shapeFromShading(photograph, {.quality = quality});
            QVERIFY(cv::checkRange(relief));
            QVERIFY(cv::norm(relief, cv::NORM_INF) < 1e-3);
        }
        QCOMPARE(estimateLight(photograph).azimuthDeg, 90.0);
    }

    void grooveIsSeenWithoutKnowingTheLight_data()
    {
        QTest::addColumn<QString>("file");
        QTest::addColumn<double>("atLeast");
        QTest::newRow("lit across") << "image02.png" << 0.75;
        QTest::newRow("lit across, other image") << "image03.png" << 0.75;
        QTest::newRow("lit from the other side") << "image05.png" << 0.75;
        QTest::newRow("lit from the other side, other image") << "image06.png" << 0.75;
        // Light along the groove reveals little of the slope of its walls and makes the light's axis ambiguous.
        QTest::newRow("lit along the groove") << "image01.png" << 0.65;
        QTest::newRow("lit along the groove, from the other end") << "image04.png" << 0.6;
    }
    void grooveIsSeenWithoutKnowingTheLight()
    {
        QFETCH(QString, file);
        QFETCH(double, atLeast);
        const auto scan = sharedData("gsmatlab_groove");
        if (!std::filesystem::exists(scan)) QSKIP("the shared groove scan does not exist");
        const auto map = rendering::readTrueMap(scan / "heightmap.tmd");
        const cv::Mat photograph = rendering::readPng(scan / file.toStdString());
        QCOMPARE(photograph.size(), map.heightMm.size());
        const auto light = estimateLight(photograph);
        const double r = correlation(inBand(shapeFromShading(photograph)), inBand(map.heightMm));
        qInfo("%s: light %.0f, coherence %.2f, r %.3f", qPrintable(file), light.azimuthDeg, light.coherence, r);
        QVERIFY(std::abs(r) >= atLeast);
    }

    void bumpsOfThePapersReferenceGiveTheSameRelief()
    {
        const cv::Mat relief = randomRelief(120, 141), photograph = lambertian(relief, 60, 45);
        ShadingOptions options;
        options.method = ShadingMethod::GaussianBumps;
        const cv::Mat found = shapeFromShading(photograph, options);
        const double r = correlation(found, relief), linear = correlation(shapeFromShading(photograph), relief);
        qInfo("bumps %.3f, linear %.3f", r, linear);
        QVERIFY(r >= 0.6);
        cv::Scalar mean, spread, known;
        cv::meanStdDev(found, mean, spread);
        cv::meanStdDev(relief, cv::noArray(), known);
        QVERIFY2(std::abs(spread[0] / known[0] - 1) < 0.6, "the method assumes a slant of 45 degrees, so heights are in pixels");
        QVERIFY(std::abs(mean[0]) < 1e-4);
    }

    void lightFromBelowTurnsBumpsIntoDents()
    {
        const cv::Mat photograph = lambertian(randomRelief(100, 100), 60, 45);
        for (const auto method : {ShadingMethod::Linear, ShadingMethod::GaussianBumps}) {
            ShadingOptions above, below;
            above.method = below.method = method;
            below.lightFromBelow = true;
            QVERIFY(correlation(shapeFromShading(photograph, above), shapeFromShading(photograph, below)) < -0.9);
        }
    }

    void dyedPatternsAreRecognised()
    {
        const cv::Mat photograph = lambertian(randomRelief(120, 120), 60, 45);
        cv::Mat grey = photograph, dyed;
        if (grey.channels() == 1) cv::cvtColor(photograph, grey, cv::COLOR_GRAY2RGB);
        QVERIFY(colourVariation(grey) < 0.5 * coloursSpoilShading);
        QCOMPARE(colourVariation(cv::Mat(20, 20, CV_8UC1, cv::Scalar(9))), 0.0);
        dyed = grey.clone();
        for (int i = 0; i < dyed.rows; ++i)
            for (int j = 0; j < dyed.cols; ++j)
                if ((i / 10 + j / 10) % 2)
                    dyed.at<cv::Vec3b>(i, j)[0] = cv::saturate_cast<uchar>(dyed.at<cv::Vec3b>(i, j)[0] * 0.4);
        QVERIFY2(colourVariation(dyed) > coloursSpoilShading, qPrintable(QString::number(colourVariation(dyed))));
        QVERIFY(std::isfinite(colourVariation(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(0)))));
    }

    /// Only the part that a display shows is computed, with its surroundings.
    void partOfALargePhotographHasTheReliefOfTheWhole()
    {
        cv::Mat tile = randomRelief(300, 400), relief;
        cv::repeat(tile, 7, 6, relief);  // 2100 x 2400
        const cv::Mat photograph = lambertian(relief, 70, 30);
        const cv::Rect part((photograph.cols - 1280) / 2, (photograph.rows - 800) / 2, 1280, 800);
        const auto found = reliefOfPart(photograph, part, estimateLight(photograph));
        const cv::Mat whole = shapeFromShading(photograph)(part);
        double low = 0, high = 0;
        cv::minMaxLoc(whole, &low, &high);
        const double levels = 255 * cv::norm(found.height, whole, cv::NORM_INF) / (high - low);
        qInfo("%.3f grey levels, %.3f of the variance left out", levels, found.varianceLeftOut);
        QVERIFY(levels < 1);
        const double outside = 1 - 1280.0 * 800 / static_cast<double>(photograph.total());
        QVERIFY(std::abs(found.varianceLeftOut - outside) < 0.05);
    }

    void anEmptyPhotographIsRefused()
    {
        QVERIFY(!refusalOf([] { shapeFromShading(cv::Mat()); }).isEmpty());
    }
};

QTEST_GUILESS_MAIN(ShapeFromShadingTest)
#include "shape_from_shading_test.moc"
