// A calibration file holds everything that a frame needs and is refused by field where it does not. A map fitted to known
// slopes reproduces them. A sensor of several lamps is calibrated on a surface of known height.
#include <QTest>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "protocols/random.h"
#include "rendering/signals/tactile/calibration.h"
#include "rendering/signals/tactile/photometric_stereo.h"
#include "rendering/signals/tactile/surface_calibration.h"
#include "tests/rendering/refusal.h"

using namespace rendering::signals;

namespace {

/// Slopes at random places, and their light under a slightly nonlinear response.
SlopeSamples drawnSamples(int count, double bend, double noise)
{
    protocols::Random random(11);
    SlopeSamples samples;
    for (int i = 0; i < count; ++i) {
        const double p = 0.5 * random.normal(), q = 0.5 * random.normal();
        const double u = 2.0 * (i % 50) / 49 - 1, v = 2.0 * (i / 50 % 40) / 39 - 1;
        const double light[] = {0.2 * p + bend * p * p, 0.2 * q + 0.05 * u * p, -0.1 * (p + q) + 0.03 * v};
        for (const double value : light) samples.light.push_back(static_cast<float>(value + noise * random.normal()));
        samples.places.insert(samples.places.end(), {static_cast<float>(u), static_cast<float>(v)});
        samples.slopes.insert(samples.slopes.end(), {static_cast<float>(p), static_cast<float>(q)});
    }
    return samples;
}

/// The samples as one frame of width 50, whose pixels lie at the places of the samples.
cv::Mat frameOf(const SlopeSamples& samples)
{
    return cv::Mat(static_cast<int>(samples.size()) / 50, 50, CV_32FC3, const_cast<float*>(samples.light.data())).clone();
}

double slopeError(const SlopeMap& map, const SlopeSamples& samples)
{
    const Slopes found = slopesOf(map, frameOf(samples));
    double sum = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const int row = static_cast<int>(i) / 50, column = static_cast<int>(i) % 50;
        sum += std::pow(found.x.at<float>(row, column) - samples.slopes[2 * i], 2) +
               std::pow(found.y.at<float>(row, column) - samples.slopes[2 * i + 1], 2);
    }
    return std::sqrt(sum / (2.0 * static_cast<double>(samples.size())));
}

Calibration with(SlopeMap map)
{
    Calibration calibration;
    calibration.map = std::move(map);
    calibration.mmPerPixel = 0.1;
    calibration.highPassCutoffMm = 3;
    calibration.sensor = SensorAppearance{160, 120, std::vector<double>(36, 0.5)};
    return calibration;
}

}  // namespace

class SensorCalibrationTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyKindOfMapIsReadBackAsWritten_data()
    {
        QTest::addColumn<int>("quality");
        QTest::newRow("linear") << int(MapQuality::Fast);
        QTest::newRow("polynomial") << int(MapQuality::Balanced);
        QTest::newRow("network") << int(MapQuality::Accurate);
    }
    void everyKindOfMapIsReadBackAsWritten()
    {
        QFETCH(int, quality);
        FitOptions options;
        options.quality = MapQuality(quality);
        options.networkSteps = 20;
        const auto calibration = with(fitSlopeMap(drawnSamples(2000, 0.02, 0.001), options));
        const auto text = toJson(calibration);
        QCOMPARE(calibrationFromJson(text, "written"), calibration);
        QVERIFY(QString::fromStdString(text).contains(QString::fromLatin1(QTest::currentDataTag())));
    }

    void moreGeneralMapsFollowABentResponse()
    {
        const auto samples = drawnSamples(2000, 0.04, 0.001);
        const auto errorAt = [&](MapQuality quality) {
            FitOptions options;
            options.quality = quality;
            return slopeError(fitSlopeMap(samples, options), samples);
        };
        const double linear = errorAt(MapQuality::Fast), polynomial = errorAt(MapQuality::Balanced),
                     network = errorAt(MapQuality::Accurate);
        qInfo("linear %.4f, polynomial %.4f, network %.4f", linear, polynomial, network);
        QVERIFY(polynomial < 0.3 * linear);
        QVERIFY(network < 0.7 * linear);
    }

    void noiseInTheLightDoesNotFlattenTheSurface()
    {
        const auto samples = drawnSamples(2000, 0, 0.05);
        const auto map = fitSlopeMap(samples, {});
        const Slopes found = slopesOf(map, frameOf(samples));
        double together = 0, known = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const int row = static_cast<int>(i) / 50, column = static_cast<int>(i) % 50;
            together += found.x.at<float>(row, column) * samples.slopes[2 * i] +
                        found.y.at<float>(row, column) * samples.slopes[2 * i + 1];
            known += std::pow(samples.slopes[2 * i], 2) + std::pow(samples.slopes[2 * i + 1], 2);
        }
        QVERIFY2(std::abs(together / known - 1) < 0.01, qPrintable(QString::number(together / known)));
    }

    void tooFewPixelsAreRefused()
    {
        QVERIFY(refusalOf([] { fitSlopeMap(drawnSamples(100, 0, 0), {}); }).contains("too few pixels"));
    }

    void malformedMapsAreRefusedByTheirField_data()
    {
        QTest::addColumn<QString>("from");
        QTest::addColumn<QString>("to");
        QTest::addColumn<QString>("named");
        QTest::newRow("degree of 60") << "\"degree\": 3"
                                      << "\"degree\": 60"
                                      << "degree";
        QTest::newRow("no degree") << "\"degree\""
                                   << "\"grade\""
                                   << "degree";
        QTest::newRow("place") << "\"by_place\": true"
                               << "\"by_place\": 1"
                               << "by_place";
        QTest::newRow("too few coefficients") << "\"by_place\": true"
                                              << "\"by_place\": false"
                                              << "coefficients";
        QTest::newRow("channels") << "\"channels\": 3"
                                  << "\"channels\": 0"
                                  << "channels";
        QTest::newRow("light") << "\"reference\""
                               << "\"moon\""
                               << "light";
        QTest::newRow("sensor") << "\"width\": 160"
                                << "\"width\": 1.5"
                                << "width";
    }
    void malformedMapsAreRefusedByTheirField()
    {
        QFETCH(QString, from);
        QFETCH(QString, to);
        QFETCH(QString, named);
        const QString sound = QString::fromStdString(toJson(with(fitSlopeMap(drawnSamples(2000, 0, 0.01), {}))));
        QVERIFY(sound.contains(from));
        const auto text = QString(sound).replace(from, to).toStdString();
        const auto refusal = refusalOf([&] { calibrationFromJson(text, "sensor.json"); });
        QVERIFY2(refusal.contains(named) && refusal.contains("sensor.json"), qPrintable(refusal));
    }

    void anotherSensorIsRecognisedByItsColours()
    {
        cv::Mat frame(120, 160, CV_8UC3, cv::Scalar(180, 100, 60)), swapped(120, 160, CV_8UC3, cv::Scalar(60, 100, 180));
        const auto known = appearanceOf(frame);
        QVERIFY(!differenceOf(known, appearanceOf(frame + cv::Scalar::all(3))).has_value());
        QVERIFY(differenceOf(known, appearanceOf(swapped)).value().find("swapped") != std::string::npos);
        QVERIFY(differenceOf(known, appearanceOf(frame * 0.6)).value().find("another sensor") != std::string::npos);
        QVERIFY(differenceOf(known, appearanceOf(frame(cv::Rect(0, 0, 80, 60)))).value().find("80 x 60") != std::string::npos);
    }

    void lampsAreCalibratedOnAKnownSurface()
    {
        // Ridges along both axes under four lamps whose light decreases over the frame; the lower half is evaluated.
        constexpr int rows = 160, columns = 200;
        constexpr double pitch = 0.05;
        protocols::Random random(2);
        cv::Mat height(rows, columns, CV_32FC1);
        std::vector<cv::Mat> lamps(4, cv::Mat());
        for (auto& lamp : lamps) lamp.create(rows, columns, CV_8UC1);
        const double k = 2 * std::numbers::pi / 1.3;
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) {
                const double x = j * pitch, y = i * pitch;
                height.at<float>(i, j) = static_cast<float>(0.05 * std::cos(k * x) * std::cos(0.8 * k * y));
                const double p = -0.05 * k * std::sin(k * x) * std::cos(0.8 * k * y),
                             q = -0.04 * k * std::cos(k * x) * std::sin(0.8 * k * y);
                for (int lamp = 0; lamp < 4; ++lamp) {
                    const double angle = std::numbers::pi * lamp / 2, towards = -(p * std::cos(angle) + q * std::sin(angle));
                    const double level =
                        (110 + 30 * std::cos(angle) * (2.0 * j / columns - 1) + 20 * std::sin(angle) * (2.0 * i / rows - 1)) *
                        (1 + 1.2 * towards);
                    lamps[static_cast<std::size_t>(lamp)].at<uchar>(i, j) = cv::saturate_cast<uchar>(level + random.normal());
                }
            }
        const KnownSurfaceFrame surface{oneFrame(lamps), {}, height, {pitch, pitch}};
        const auto calibration = calibrationFrom(surface, 0, rows / 2);
        QCOMPARE(calibration.light, LightMeasure::AgainstOwnLight);
        QCOMPARE(calibration.channels, 4);
        const auto score = scoreOf(calibration, surface, rows / 2, rows);
        qInfo("%.2f um of Sq %.1f um", 1000 * score.heightErrorMm, 1000 * score.knownSqMm);
        QVERIFY(score.heightErrorMm < 0.1 * score.knownSqMm);
        QVERIFY(refusalOf([&] { calibrationFrom(surface, 10, 10); }).contains("rows 10 to 10"));
        const KnownSurfaceFrame inMicrometres{surface.frame, {}, cv::Mat(1000 * height), surface.pitch};
        QVERIFY(refusalOf([&] { calibrationFrom(inMicrometres, 0, rows / 2); }).contains("steeper than 10 mm per mm"));
        cv::Mat integers;
        height.convertTo(integers, CV_16U, 1000);
        const KnownSurfaceFrame ofIntegers{surface.frame, {}, integers, surface.pitch};
        QVERIFY(refusalOf([&] { calibrationFrom(ofIntegers, 0, rows / 2); }).contains("1 channels of 16 bits"));
        QVERIFY(refusalOf([&] { slopesFromFrame(lamps[0], {}, calibration); }).contains("1 channel"));
    }
};

QTEST_GUILESS_MAIN(SensorCalibrationTest)
#include "sensor_calibration_test.moc"
