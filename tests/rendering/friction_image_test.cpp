#include "rendering/friction_image.h"

#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "refusal.h"

using namespace rendering;
using protocols::conditionNamed;

namespace {

/// Every pixel its own value, so that a misplaced one shows.
cv::Mat ramp(int rows, int columns)
{
    cv::Mat image(rows, columns, CV_32FC1);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) image.at<float>(i, j) = static_cast<float>(i * columns + j);
    return image;
}

Sources reliefOnly(const cv::Mat& relief)
{
    Sources sources;
    sources.relief = relief;
    return sources;
}

MapRange rangeOf(const std::vector<ScaledMap>& maps)
{
    MapRange range;
    for (const auto& map : maps) range.include(map);
    return range;
}

double spread(const cv::Mat& values)
{
    cv::Scalar mean, sd;
    cv::meanStdDev(values, mean, sd);
    return sd[0];
}

}  // namespace

class FrictionImageTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void smallReliefIsCentredAndMirrored_data()
    {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("columns");
        QTest::newRow("GelSight") << 240 << 320;
        QTest::newRow("odd") << 99 << 101;
        QTest::newRow("narrow") << 800 << 7;
        QTest::newRow("one pixel") << 1 << 1;
    }
    void smallReliefIsCentredAndMirrored()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const cv::Mat relief = ramp(rows, columns);
        const auto map = compose(conditionNamed("h"), reliefOnly(relief), Scale::Pixels);
        QCOMPARE(map.values.size(), cv::Size(1280, 800));
        QCOMPARE(map.extension, std::string("mirror"));
        const int left = (1280 - columns) / 2, top = (800 - rows) / 2;
        QCOMPARE(cv::norm(map.values(cv::Rect(left, top, columns, rows)), relief, cv::NORM_INF), 0.0);
        // Seamless: over the border the same value again, then back into the relief.
        for (int k = 0; k < std::min(columns, left); ++k)
            QCOMPARE(map.values.at<float>(top, left - 1 - k), relief.at<float>(0, k));
        for (int k = 0; k < std::min(rows, 800 - top - rows); ++k)
            QCOMPARE(map.values.at<float>(top + rows + k, left), relief.at<float>(rows - 1 - k, 0));
    }

    void largeReliefIsCroppedInItsMiddle()
    {
        const cv::Mat relief = ramp(1000, 1500);
        const auto map = compose(conditionNamed("v_grey"), reliefOnly(relief), Scale::Pixels);
        QCOMPARE(cv::norm(map.values, relief(cv::Rect(110, 100, 1280, 800)), cv::NORM_INF), 0.0);
        QCOMPARE(map.extension, std::string("none (cropped)"));
        QCOMPARE(compose(conditionNamed("v_grey"), reliefOnly(ramp(800, 1280)), Scale::Pixels).extension, std::string("none"));
        QCOMPARE(compose(conditionNamed("v_grey"), reliefOnly(ramp(500, 2000)), Scale::Pixels).extension, std::string("mirror"));
    }

    void traceRunsAlongTheStroke()
    {
        Sources sources;
        for (int i = 0; i < 480; ++i) sources.trace.push_back(0.5 + 0.001 * i);
        const auto map = compose(conditionNamed("f"), sources, Scale::Pixels);
        for (const int row : {0, 399, 799}) {
            for (int i = 0; i < 480; ++i)
                QCOMPARE(map.values.at<float>(row, 400 + i), static_cast<float>(sources.trace[static_cast<std::size_t>(i)]));
            QCOMPARE(map.values.at<float>(row, 399), map.values.at<float>(row, 400));
            QCOMPARE(map.values.at<float>(row, 880), map.values.at<float>(row, 879));
        }
    }

    void frictionScalesTheRelief()
    {
        auto sources = reliefOnly(ramp(10, 10));
        sources.meanFriction = 0.25;
        const auto map = compose(conditionNamed("h&f"), sources, Scale::Pixels);
        QCOMPARE(cv::norm(map.values, 0.25 * compose(conditionNamed("h"), sources, Scale::Pixels).values, cv::NORM_INF), 0.0);
        sources.meanFriction.reset();
        QVERIFY(refusalOf([&] { compose(conditionNamed("h&f"), sources, Scale::Pixels); }).contains("mean friction"));
    }

    void physicalScaleKeepsMillimetres_data()
    {
        QTest::addColumn<double>("pitch");
        QTest::newRow("finer than the display") << 0.05;
        QTest::newRow("coarser than the display") << 0.4;
        QTest::newRow("the display's own") << displayMmPerPixel;
    }
    void physicalScaleKeepsMillimetres()
    {
        QFETCH(double, pitch);
        // A wave of 4 mm, its crest in the middle of the source.
        const int n = 401;
        cv::Mat relief(n, n, CV_32FC1);
        const auto wave = [](double mm) { return std::cos(2 * std::numbers::pi * mm / 4); };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) relief.at<float>(i, j) = static_cast<float>(wave((j - 200) * pitch));
        auto sources = reliefOnly(relief);
        sources.reliefMmPerPixel = pitch;
        const auto map = compose(conditionNamed("h"), sources, Scale::Physical);
        // Crest to crest on the screen, counted near its middle.
        const cv::Mat row = map.values.row(400);
        double bestCorrelation = -1, bestCentre = 0;
        for (double centre = 630; centre <= 650; centre += 0.25) {
            double sum = 0;
            for (int j = -40; j <= 40; ++j) sum += row.at<float>(640 + j) * wave((640 + j - centre) * displayMmPerPixel);
            if (sum > bestCorrelation) {
                bestCorrelation = sum;
                bestCentre = centre;
            }
        }
        QVERIFY2(std::abs(bestCentre - 639.5) <= 1, qPrintable(QString::number(bestCentre)));
        for (int j = -40; j <= 40; ++j)
            QVERIFY(std::abs(row.at<float>(640 + j) - wave((640 + j - bestCentre) * displayMmPerPixel)) < 0.06);
    }

    void textureFinerThanTheDisplayDoesNotFold()
    {
        // 0.2 mm at 0.05 mm per pixel: 1.2 pixels of the display, which would fold to a coarse wave.
        cv::Mat relief(400, 400, CV_32FC1);
        for (int i = 0; i < 400; ++i)
            for (int j = 0; j < 400; ++j) relief.at<float>(i, j) = static_cast<float>(std::cos(2 * std::numbers::pi * j / 4));
        auto sources = reliefOnly(relief);
        sources.reliefMmPerPixel = 0.05;
        const auto map = compose(conditionNamed("h"), sources, Scale::Physical);
        const cv::Mat middle = map.values(cv::Rect(600, 360, 80, 80));
        QVERIFY2(spread(middle) < 0.04 * spread(relief), qPrintable(QString::number(spread(middle))));
    }

    void physicalTraceKeepsMillimetres()
    {
        Sources sources;
        sources.traceMmPerSample = 5.0 / 60;
        for (int i = 0; i < 480; ++i) sources.trace.push_back(i < 240 ? 0.0 : 1.0);
        const auto map = compose(conditionNamed("f"), sources, Scale::Physical);
        // 40 mm are 235 pixels: the step in the middle, undone in the mirror image 40 mm to its right.
        const auto at = [&](int place) { return map.values.at<float>(400, place); };
        QVERIFY(at(635) < 0.01F && at(645) > 0.99F);
        QVERIFY(at(640 + 230) > 0.99F && at(640 + 240) < 0.01F);
        QVERIFY(at(640 - 230) < 0.01F && at(640 - 240) > 0.99F);
    }

    void physicalScaleNeedsAPitch()
    {
        QVERIFY(
            refusalOf([] { compose(conditionNamed("h"), reliefOnly(ramp(5, 5)), Scale::Physical); }).contains("mm_per_pixel"));
        Sources sources;
        sources.trace = {0.1, 0.2};
        QVERIFY(!refusalOf([&] { compose(conditionNamed("f"), sources, Scale::Physical); }).isEmpty());
    }

    void rangeOfAllObjectsBecomes0To255()
    {
        const auto low = compose(conditionNamed("h"), reliefOnly(cv::Mat(2, 2, CV_32FC1, cv::Scalar(1))), Scale::Pixels);
        const auto middle = compose(conditionNamed("h"), reliefOnly(cv::Mat(2, 2, CV_32FC1, cv::Scalar(2.2))), Scale::Pixels);
        const auto high = compose(conditionNamed("h"), reliefOnly(cv::Mat(2, 2, CV_32FC1, cv::Scalar(4))), Scale::Pixels);
        const auto range = rangeOf({low, high, middle});
        QCOMPARE(range.min, 1.0);
        QCOMPARE(range.max, 4.0);
        QCOMPARE(int(mapToDisplay(low, range).at<unsigned char>(7, 7)), 0);
        QCOMPARE(int(mapToDisplay(middle, range).at<unsigned char>(7, 7)), 102);
        QCOMPARE(int(mapToDisplay(high, range).at<unsigned char>(7, 7)), 255);
    }

    void valuesAreRoundedNotCut()
    {
        ScaledMap map{(cv::Mat_<float>(1, 4) << 0.F, 0.6F, 254.4F, 255.F), "none"};
        const cv::Mat image = mapToDisplay(map, rangeOf({map}));
        QCOMPARE(cv::norm(image, cv::Mat((cv::Mat_<unsigned char>(1, 4) << 0, 1, 254, 255)), cv::NORM_INF), 0.0);
    }

    void narrowRangeFarFromZeroKeepsItsLevels()
    {
        cv::Mat relief(1, 256, CV_32FC1);
        for (int j = 0; j < 256; ++j) relief.at<float>(0, j) = 1000.F + static_cast<float>(j) / 1024;
        const ScaledMap map{relief, "none"};
        const cv::Mat image = mapToDisplay(map, rangeOf({map}));
        for (int j = 0; j < 256; ++j) QCOMPARE(int(image.at<unsigned char>(0, j)), j);
    }

    void constantRangeMapsTo0()
    {
        const auto map = compose(conditionNamed("h"), reliefOnly(cv::Mat(3, 3, CV_32FC1, cv::Scalar(0.7))), Scale::Pixels);
        QVERIFY(rangeOf({map}).constant());
        QCOMPARE(cv::countNonZero(mapToDisplay(map, rangeOf({map}))), 0);
        QCOMPARE(mapToDisplay(map, {}).size(), cv::Size(1280, 800));
    }

    /// Why the range is that of all objects: image by image, h&f would be h.
    void meanFrictionIsFeltOnlyBecauseTheRangeIsCommon()
    {
        auto rough = reliefOnly(ramp(40, 40)), smooth = reliefOnly(ramp(40, 40).t());
        rough.meanFriction = 0.8;
        smooth.meanFriction = 0.2;
        const auto imageOf = [](const char* condition, const Sources& sources, const std::vector<Sources>& all) {
            std::vector<ScaledMap> maps;
            for (const auto& one : all) maps.push_back(compose(conditionNamed(condition), one, Scale::Pixels));
            return mapToDisplay(compose(conditionNamed(condition), sources, Scale::Pixels), rangeOf(maps));
        };
        const cv::Mat alone = imageOf("h&f", smooth, {smooth}), reliefAlone = imageOf("h", smooth, {smooth});
        QVERIFY(cv::norm(alone, reliefAlone, cv::NORM_INF) <= 1);

        const cv::Mat together = imageOf("h&f", smooth, {rough, smooth}), relief = imageOf("h", smooth, {rough, smooth});
        QVERIFY(cv::norm(together, relief, cv::NORM_INF) > 180);
        double highest = 0;
        cv::minMaxLoc(together, nullptr, &highest);
        QCOMPARE(highest, 64.0);  // 255 * 0.2 / 0.8
    }

    void brokenSignalsAreRefused()
    {
        cv::Mat broken = ramp(4, 4);
        broken.at<float>(1, 1) = std::numeric_limits<float>::quiet_NaN();
        QVERIFY(refusalOf([&] { compose(conditionNamed("h"), reliefOnly(broken), Scale::Pixels); }).contains("not finite"));
        QVERIFY(refusalOf([&] { compose(conditionNamed("f"), {}, Scale::Pixels); }).contains("empty"));
    }
};

QTEST_GUILESS_MAIN(FrictionImageTest)
#include "friction_image_test.moc"
