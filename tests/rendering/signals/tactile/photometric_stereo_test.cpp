#include "rendering/signals/tactile/photometric_stereo.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "rendering/fabrics/procedural/tactile_press.h"
#include "tests/rendering/refusal.h"

using namespace rendering::signals;

namespace {

constexpr double pitchMm = 0.05;

/// A sensor whose red measures slopes along x and green slopes along y; blue measures nothing.
Calibration plainSensor()
{
    Calibration calibration;
    calibration.map = LinearMap{{{{2, 0, 0}, {0, -4, 0}}}, {}};
    calibration.mmPerPixel = pitchMm;
    calibration.zeroPercentile = 0;
    return calibration;
}

/// Round bumps 1.6 mm apart, 0.1 mm high.
double bump(double x, double y)
{
    const double k = 2 * std::numbers::pi / 1.6;
    return 0.05 * (1 + std::cos(k * x) * std::cos(k * y));
}

cv::Mat bumps(int rows, int columns)
{
    cv::Mat height(rows, columns, CV_32FC1);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) height.at<float>(i, j) = static_cast<float>(bump(j * pitchMm, i * pitchMm));
    return height;
}

/// Frame of plainSensor on the bumps; the slopes are the derivative of the formula.
cv::Mat frameOfBumps(int rows, int columns)
{
    cv::Mat frame(rows, columns, CV_8UC3);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double x = j * pitchMm, y = i * pitchMm, d = 1e-6;
            const double gx = (bump(x + d, y) - bump(x - d, y)) / (2 * d), gy = (bump(x, y + d) - bump(x, y - d)) / (2 * d);
            frame.at<cv::Vec3b>(i, j) = {cv::saturate_cast<unsigned char>(128 + 255 * gx / 2),
                                         cv::saturate_cast<unsigned char>(100 + 255 * gy / -4), 90};
        }
    return frame;
}

const cv::Scalar untouched(128, 100, 90);

const char* const soundJson = R"({"schema":"vis2hap.calibration/1","kind":"linear","gradient_from_rgb":[[1,2,3],[4,5,6]],
    "offset":[0.5,-0.25],"mm_per_pixel":0.05,"high_pass_cutoff_mm":3,"zero_percentile":2})";

}  // namespace

class PhotometricStereoTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void bumpsComeBackInMillimetres_data()
    {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("columns");
        QTest::addColumn<bool>("fast");
        QTest::newRow("even") << 120 << 160 << false;
        QTest::newRow("odd") << 121 << 97 << false;
        QTest::newRow("fast") << 120 << 160 << true;
    }
    void bumpsComeBackInMillimetres()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        QFETCH(bool, fast);
        const cv::Mat frame = frameOfBumps(rows, columns), reference(frame.size(), CV_8UC3, untouched);
        const cv::Mat height =
            heightFromFrame(frame, reference, plainSensor(), fast ? IntegrationQuality::Fast : IntegrationQuality::Full);
        QCOMPARE(height.type(), CV_32FC1);
        const cv::Mat known = bumps(rows, columns);
        // Rounding to 8 bits and the mean of neighbouring slopes cause 2 um of error in a height of 100 um.
        QVERIFY(cv::norm(height, known, cv::NORM_L2) / std::sqrt(static_cast<double>(known.total())) < 0.003);
        QVERIFY(cv::norm(height, known, cv::NORM_INF) < 0.012);
    }

    void offsetIsATilt()
    {
        auto calibration = plainSensor();
        std::get<LinearMap>(calibration.map).offset = {0.2, 0};
        const cv::Mat same(9, 21, CV_8UC3, untouched);
        const cv::Mat height = heightFromFrame(same, same, calibration);
        QVERIFY(std::abs(height.at<float>(4, 20) - 20 * pitchMm * 0.2) < 1e-5);
        QVERIFY(std::abs(height.at<float>(4, 0)) < 1e-5);
    }

    void slowSurfaceIsRemovedAndTheBumpsStay()
    {
        auto calibration = plainSensor();
        std::get<LinearMap>(calibration.map).offset = {0.05, 0.1};
        calibration.highPassCutoffMm = 6;
        calibration.zeroPercentile = 2;
        const cv::Mat frame = frameOfBumps(240, 320), reference(frame.size(), CV_8UC3, untouched);
        const cv::Mat height = heightFromFrame(frame, reference, calibration);
        double low = 0, high = 0;
        const cv::Mat inner = height(cv::Rect(40, 40, 240, 160));
        cv::minMaxLoc(inner, &low, &high);
        QVERIFY(low >= 0);
        QVERIFY2(high > 0.08 && high < 0.16, qPrintable(QString::number(high)));
        const double atZero = 1 - static_cast<double>(cv::countNonZero(height)) / static_cast<double>(height.total());
        QVERIFY2(std::abs(atZero - 0.02) < 0.005, qPrintable(QString::number(atZero)));
    }

    void untouchedSensorIsFlat()
    {
        auto calibration = plainSensor();
        calibration.highPassCutoffMm = 3;
        const cv::Mat same(17, 30, CV_8UC3, untouched);
        QCOMPARE(cv::norm(heightFromFrame(same, same, calibration), cv::NORM_INF), 0.0);
    }

    void simulatedSensorIsReadByItsOwnCalibration()
    {
        const auto calibration = calibrationFromJson(rendering::fabrics::tactileCalibrationJson(), "simulated sensor");
        protocols::Random random(3);
        const cv::Mat known = bumps(rendering::fabrics::tactileHeightPx, rendering::fabrics::tactileWidthPx);
        const cv::Mat frame = rendering::fabrics::tactileFrame(known, random);
        const cv::Mat found = heightFromFrame(frame, rendering::fabrics::tactileReference(), calibration);
        const Pitch pitch{calibration.mmPerPixel, calibration.mmPerPixel};
        const cv::Mat truth = zeroedRelief(known, pitch, calibration.highPassCutoffMm, calibration.zeroPercentile);
        cv::Scalar mean, sd;
        cv::meanStdDev(truth, mean, sd);
        const double error = cv::norm(found, truth) / std::sqrt(static_cast<double>(truth.total()));
        qInfo("simulated sensor: RMS error %.1f um of Sq %.1f um", 1000 * error, 1000 * sd[0]);
        QVERIFY(error < 0.25 * sd[0]);
    }

    void calibrationIsReadBackAsWritten()
    {
        const auto calibration = calibrationFromJson(soundJson, "text");
        QCOMPARE(std::get<LinearMap>(calibration.map).gain[1][0], 4.0);
        QCOMPARE(std::get<LinearMap>(calibration.map).offset[1], -0.25);
        QCOMPARE(calibration.highPassCutoffMm.value(), 3.0);
        QTemporaryDir folder;
        const auto file = std::filesystem::path(folder.filePath("c.json").toStdString());
        std::ofstream(file) << toJson(calibration);
        QVERIFY(readCalibration(file) == calibration);
        auto open = calibration;
        open.highPassCutoffMm.reset();
        QVERIFY(calibrationFromJson(toJson(open), "text") == open);
    }

    void malformedCalibrationIsRefusedByItsField_data()
    {
        QTest::addColumn<QString>("from");
        QTest::addColumn<QString>("to");
        QTest::addColumn<QString>("named");
        QTest::newRow("schema") << "calibration/1"
                                << "calibration/9"
                                << "schema";
        QTest::newRow("kind") << "linear"
                              << "cubic"
                              << "kind";
        QTest::newRow("matrix") << "[4,5,6]"
                                << "[4,5]"
                                << "gradient_from_rgb";
        QTest::newRow("text for a number") << "[0.5,"
                                           << "[\"0.5\","
                                           << "offset";
        QTest::newRow("pitch of 0") << "\"mm_per_pixel\":0.05"
                                    << "\"mm_per_pixel\":0"
                                    << "mm_per_pixel";
        QTest::newRow("no pitch") << "mm_per_pixel"
                                  << "mm_per_inch"
                                  << "mm_per_pixel";
        QTest::newRow("cut-off below 0") << "_mm\":3"
                                         << "_mm\":-3"
                                         << "high_pass_cutoff_mm";
        QTest::newRow("percentile") << "percentile\":2"
                                    << "percentile\":80"
                                    << "zero_percentile";
        QTest::newRow("no JSON") << "{"
                                 << ""
                                 << "malformed JSON";
    }
    void malformedCalibrationIsRefusedByItsField()
    {
        QFETCH(QString, from);
        QFETCH(QString, to);
        QFETCH(QString, named);
        const auto text = QString(soundJson).replace(from, to).toStdString();
        const auto refusal = refusalOf([&] { calibrationFromJson(text, "sensor.json"); });
        QVERIFY2(refusal.contains(named) && refusal.contains("sensor.json"), qPrintable(refusal));
    }

    void normalMapsBecomeSlopes()
    {
        // A plane that rises by 0.3 to the right and by 0.2 downwards has the normal (-0.3, 0.2 up, 1) before normalisation.
        const double length = std::sqrt(1 + 0.09 + 0.04);
        const auto stored = [&](double n) { return static_cast<unsigned short>(std::lround(65535 * (n / length + 1) / 2)); };
        cv::Mat normals(6, 8, CV_16UC3, cv::Scalar(stored(-0.3), stored(0.2), stored(1)));
        normals.at<cv::Vec3w>(2, 3) = {32768, 32768, 0};
        const auto slopes = slopesFromNormals(normals);
        QVERIFY(std::abs(slopes.x.at<float>(0, 0) - 0.3) < 1e-3);
        QVERIFY(std::abs(slopes.y.at<float>(0, 0) - 0.2) < 1e-3);
        QVERIFY2(std::isnan(slopes.x.at<float>(2, 3)), "a normal that faces away must give NaN");
        const cv::Mat height = integrateAround(slopes, {}, {0.1, 0.1});
        QVERIFY(std::abs(height.at<double>(5, 7) - height.at<double>(0, 0) - 0.1 * (0.3 * 7 + 0.2 * 5)) < 1e-3);
        QVERIFY(refusalOf([] { slopesFromNormals(cv::Mat(4, 4, CV_8UC1, cv::Scalar(1))); }).contains("not a normal map"));
    }

    void extremeFramesHaveADefinedHeight_data()
    {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("columns");
        QTest::addColumn<int>("level");
        QTest::newRow("black") << 12 << 20 << 0;
        QTest::newRow("saturated") << 12 << 20 << 255;
        QTest::newRow("one pixel") << 1 << 1 << 90;
        QTest::newRow("one row") << 1 << 33 << 255;
        QTest::newRow("one column") << 33 << 1 << 0;
    }
    void extremeFramesHaveADefinedHeight()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        QFETCH(int, level);
        auto calibration = plainSensor();
        calibration.highPassCutoffMm = 3;
        const cv::Mat frame(rows, columns, CV_8UC3, cv::Scalar::all(level)), reference(rows, columns, CV_8UC3, untouched);
        const cv::Mat height = heightFromFrame(frame, reference, calibration);
        QCOMPARE(height.size(), frame.size());
        QVERIFY(cv::checkRange(height));
        QVERIFY(!hasOutside(lightOf(reference, reference, LightMeasure::AgainstReference)));
        const cv::Mat nowhere =
            contactOf(cv::Mat::zeros(rows, columns, CV_32FC1), lightOf(reference, reference, LightMeasure::AgainstReference))
                .places;
        QCOMPARE(cv::countNonZero(nowhere), 0);
        QVERIFY(cv::checkRange(heightInContact(slopesFromFrame(frame, reference, calibration), nowhere, {0.05, 0.05})));
    }

    /// One NaN would stay in the map, and the percentile of such numbers has no meaning.
    void aHeightWithAGapHasNoZero()
    {
        cv::Mat height = bumps(12, 20);
        height.at<float>(3, 4) = std::numeric_limits<float>::quiet_NaN();
        const QString refusal = refusalOf([&] { zeroedRelief(height, {pitchMm, pitchMm}, std::nullopt, 2); });
        QVERIFY2(refusal.contains("not finite"), qPrintable(refusal));
    }

    void frameAndReferenceMustBelongTogether()
    {
        const cv::Mat small(4, 4, CV_8UC3, untouched), large(5, 4, CV_8UC3, untouched), grey(4, 4, CV_8UC1, cv::Scalar(1));
        QVERIFY(refusalOf([&] { heightFromFrame(small, large, plainSensor()); }).contains("4 x 5"));
        QVERIFY(!refusalOf([&] { heightFromFrame(grey, small, plainSensor()); }).isEmpty());
        QVERIFY(refusalOf([&] { readCalibration("/nowhere/c.json"); }).contains("/nowhere/c.json"));
    }
};

QTEST_GUILESS_MAIN(PhotometricStereoTest)
#include "photometric_stereo_test.moc"
