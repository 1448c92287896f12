// A live view of a tactile sensor: the fast images are those of `render` within rounding, and none depends on an earlier frame.
#include "rendering/composition/frame_images.h"

#include <QTest>
#include <cmath>
#include <opencv2/core.hpp>

#include "tests/rendering/refusal.h"

using namespace rendering;

namespace {

constexpr int rows = 120, columns = 160;

signals::Calibration calibration()
{
    signals::Calibration made;
    signals::PolynomialMap map;
    map.degree = 2;
    map.byPlace = false;
    const auto count = signals::monomials(3, 2).size();
    map.coefficients = {std::vector<double>(count, 0.01), std::vector<double>(count, -0.01)};
    map.coefficients[0][0] = map.coefficients[1][0] = 0;  // without light, no slope
    map.coefficients[0][1] = map.coefficients[1][2] = 0.5;
    made.map = map;
    made.mmPerPixel = 0.05;
    made.highPassCutoffMm = 3;
    return made;
}

cv::Mat reference() { return {rows, columns, CV_8UC3, cv::Scalar(110, 120, 130)}; }

/// A weave of `period` pixels.
cv::Mat frame(double period)
{
    cv::Mat image = reference();
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            auto& pixel = image.at<cv::Vec3b>(i, j);
            pixel[0] = static_cast<unsigned char>(pixel[0] + std::lround(30 * std::sin(6.2832 * j / period)));
            pixel[1] = static_cast<unsigned char>(pixel[1] + std::lround(30 * std::cos(6.2832 * i / (period + 3))));
        }
    return image;
}

}  // namespace

class FrameImagesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void fastImagesAreTheAccurateOnesWithinALevel_data()
    {
        QTest::addColumn<bool>("tiled");
        QTest::addColumn<double>("period");
        for (const bool tiled : {true, false})
            for (const double period : {8.0, 11.3}) QTest::addRow("%s %g", tiled ? "tile" : "mirror", period) << tiled << period;
    }
    void fastImagesAreTheAccurateOnesWithinALevel()
    {
        QFETCH(bool, tiled);
        QFETCH(double, period);
        const auto extension = tiled ? Extension::Tile : Extension::Mirror;
        const auto range = frameRange(frame(period), reference(), calibration(), extension);
        FrameImages images(calibration(), reference(), range, extension);
        const cv::Mat fast = images.imageOf(frame(period)).clone();
        const cv::Mat accurate = frameImage(frame(period), reference(), calibration(), range, extension);
        QCOMPARE(fast.size(), cv::Size(1280, 800));
        QCOMPARE(fast.type(), CV_8UC1);
        const double rms = cv::norm(fast, accurate) / std::sqrt(static_cast<double>(fast.total()));
        QVERIFY2(rms < 1.5, qPrintable(QString("%1 levels").arg(rms)));
        double low = 0, high = 0;
        cv::minMaxLoc(fast, &low, &high);
        QVERIFY(low < 3 && high > 250);
    }

    void imageFollowsFromItsFrameAlone()
    {
        const auto range = frameRange(frame(8), reference(), calibration());
        FrameImages once(calibration(), reference(), range), after(calibration(), reference(), range);
        for (const double period : {15.0, 9.0}) after.imageOf(frame(period));
        QCOMPARE(cv::norm(once.imageOf(frame(8)), after.imageOf(frame(8)), cv::NORM_INF), 0.0);
    }

    void untouchedSensorShowsNothing()
    {
        FrameImages images(calibration(), reference(), frameRange(frame(8), reference(), calibration()));
        QCOMPARE(cv::countNonZero(images.imageOf(reference())), 0);
        FrameImages flat(calibration(), reference(), frameRange(reference(), reference(), calibration()));
        QCOMPARE(cv::countNonZero(flat.imageOf(frame(8))), 0);  // a range without extent
    }

    void frameOfAnotherSensorIsRefused()
    {
        FrameImages images(calibration(), reference(), frameRange(frame(8), reference(), calibration()));
        QVERIFY(refusalOf([&] { images.imageOf(cv::Mat(rows, columns + 1, CV_8UC3)); }).contains("does not match"));
        QVERIFY(refusalOf([&] { images.imageOf(cv::Mat(rows, columns, CV_8UC1)); }).contains("channel"));
        QVERIFY(refusalOf([] { FrameImages(calibration(), cv::Mat(), MapRange{}); }).contains("empty"));
    }
};

QTEST_APPLESS_MAIN(FrameImagesTest)
#include "frame_images_test.moc"
