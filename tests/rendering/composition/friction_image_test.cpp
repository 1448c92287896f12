#include "rendering/composition/friction_image.h"

#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "rendering/composition/display_mapping.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using protocols::conditionNamed;

namespace {

/// Every pixel has its own value, so that a misplaced pixel is noticed.
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
        const auto map = compose(conditionNamed("h"), reliefOnly(relief), DisplayScale::Pixels, Extension::Mirror);
        QCOMPARE(map.values.size(), cv::Size(1280, 800));
        QCOMPARE(map.extension, std::string("mirror"));
        const int left = (1280 - columns) / 2, top = (800 - rows) / 2;
        QCOMPARE(cv::norm(map.values(cv::Rect(left, top, columns, rows)), relief, cv::NORM_INF), 0.0);
        // Without a seam: across the border the same value occurs again, and then the relief is mirrored.
        for (int k = 0; k < std::min(columns, left); ++k)
            QCOMPARE(map.values.at<float>(top, left - 1 - k), relief.at<float>(0, k));
        for (int k = 0; k < std::min(rows, 800 - top - rows); ++k)
            QCOMPARE(map.values.at<float>(top + rows + k, left), relief.at<float>(rows - 1 - k, 0));
    }

    void largeReliefIsCroppedInItsMiddle()
    {
        const cv::Mat relief = ramp(1000, 1500);
        const auto map = compose(conditionNamed("v_grey"), reliefOnly(relief), DisplayScale::Pixels);
        QCOMPARE(cv::norm(map.values, relief(cv::Rect(110, 100, 1280, 800)), cv::NORM_INF), 0.0);
        QCOMPARE(map.extension, std::string("none (cropped)"));
        QCOMPARE(compose(conditionNamed("v_grey"), reliefOnly(ramp(800, 1280)), DisplayScale::Pixels).extension,
                 std::string("none"));
        QCOMPARE(
            compose(conditionNamed("v_grey"), reliefOnly(ramp(500, 2000)), DisplayScale::Pixels, Extension::Mirror).extension,
            std::string("mirror"));
    }

    void traceRunsAlongTheStroke()
    {
        Sources sources;
        for (int i = 0; i < 480; ++i) sources.trace.push_back(0.5 + 0.001 * i);
        const auto map = compose(conditionNamed("f"), sources, DisplayScale::Pixels, Extension::Mirror);
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
        const auto map = compose(conditionNamed("h&f"), sources, DisplayScale::Pixels);
        QCOMPARE(cv::norm(map.values, 0.25 * compose(conditionNamed("h"), sources, DisplayScale::Pixels).values, cv::NORM_INF),
                 0.0);
        sources.meanFriction.reset();
        QVERIFY(refusalOf([&] { compose(conditionNamed("h&f"), sources, DisplayScale::Pixels); }).contains("mean friction"));
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
        // A wave of 4 mm with a crest in the middle of the source.
        const int n = 401;
        cv::Mat relief(n, n, CV_32FC1);
        const auto wave = [](double mm) { return std::cos(2 * std::numbers::pi * mm / 4); };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) relief.at<float>(i, j) = static_cast<float>(wave((j - 200) * pitch));
        auto sources = reliefOnly(relief);
        sources.reliefMmPerPixel = pitch;
        const auto map = compose(conditionNamed("h"), sources, DisplayScale::Physical);
        // Distance between crests on the screen, near its middle.
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

    void textureFinerThanTheDisplayIsNotAliased()
    {
        // 0.2 mm at 0.05 mm per pixel are 1.2 pixels of the display, which would be aliased to a coarse wave.
        cv::Mat relief(400, 400, CV_32FC1);
        for (int i = 0; i < 400; ++i)
            for (int j = 0; j < 400; ++j) relief.at<float>(i, j) = static_cast<float>(std::cos(2 * std::numbers::pi * j / 4));
        auto sources = reliefOnly(relief);
        sources.reliefMmPerPixel = 0.05;
        const auto map = compose(conditionNamed("h"), sources, DisplayScale::Physical);
        const cv::Mat middle = map.values(cv::Rect(600, 360, 80, 80));
        QVERIFY2(spread(middle) < 0.04 * spread(relief), qPrintable(QString::number(spread(middle))));
    }

    void physicalTraceKeepsMillimetres()
    {
        Sources sources;
        sources.traceMmPerSample = 5.0 / 60;
        for (int i = 0; i < 480; ++i) sources.trace.push_back(i < 240 ? 0.0 : 1.0);
        const auto map = compose(conditionNamed("f"), sources, DisplayScale::Physical, Extension::Mirror);
        // 40 mm are 235 pixels: the step lies in the middle, and its mirror image 40 mm to the right reverses it.
        const auto at = [&](int place) { return map.values.at<float>(400, place); };
        QVERIFY(at(635) < 0.01F && at(645) > 0.99F);
        QVERIFY(at(640 + 230) > 0.99F && at(640 + 240) < 0.01F);
        QVERIFY(at(640 - 230) < 0.01F && at(640 - 240) > 0.99F);
    }

    void physicalScaleNeedsAPitch()
    {
        QVERIFY(refusalOf([] {
                    compose(conditionNamed("h"), reliefOnly(ramp(5, 5)), DisplayScale::Physical);
                }).contains("mm_per_pixel"));
        Sources sources;
        sources.trace = {0.1, 0.2};
        QVERIFY(!refusalOf([&] { compose(conditionNamed("f"), sources, DisplayScale::Physical); }).isEmpty());
    }

    void rangeOfAllObjectsBecomes0To255()
    {
        const auto low = compose(conditionNamed("h"), reliefOnly(cv::Mat(2, 2, CV_32FC1, cv::Scalar(1))), DisplayScale::Pixels);
        const auto middle =
            compose(conditionNamed("h"), reliefOnly(cv::Mat(2, 2, CV_32FC1, cv::Scalar(2.2))), DisplayScale::Pixels);
        const auto high = compose(conditionNamed("h"), reliefOnly(cv::Mat(2, 2, CV_32FC1, cv::Scalar(4))), DisplayScale::Pixels);
        const auto range = rangeOf({low, high, middle});
        QCOMPARE(range.min, 1.0);
        QCOMPARE(range.max, 4.0);
        QCOMPARE(int(mapToDisplay(low, range).at<unsigned char>(7, 7)), 0);
        QCOMPARE(int(mapToDisplay(middle, range).at<unsigned char>(7, 7)), 102);
        QCOMPARE(int(mapToDisplay(high, range).at<unsigned char>(7, 7)), 255);
    }

    void valuesAreRounded()
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
        const auto map = compose(conditionNamed("h"), reliefOnly(cv::Mat(3, 3, CV_32FC1, cv::Scalar(0.7))), DisplayScale::Pixels);
        QVERIFY(rangeOf({map}).constant());
        QCOMPARE(cv::countNonZero(mapToDisplay(map, rangeOf({map}))), 0);
        QCOMPARE(mapToDisplay(map, {}).size(), cv::Size(1280, 800));
    }

    void sixteenBitsKeepWhatEightRoundAway()
    {
        const ScaledMap map{(cv::Mat_<float>(1, 3) << 0.F, 0.0001F, 1.F), "none"};
        const auto range = rangeOf({map});
        const cv::Mat image = mapToDisplay(map, range, {.bits = 16});
        QCOMPARE(image.type(), CV_16UC1);
        QCOMPARE(int(image.at<std::uint16_t>(0, 1)), 7);
        QCOMPARE(int(image.at<std::uint16_t>(0, 2)), 65535);
        QCOMPARE(int(mapToDisplay(map, range).at<unsigned char>(0, 1)), 0);
    }

    void ditheredLevelsAreRightOnAverage()
    {
        cv::Mat values(300, 400, CV_32FC1, cv::Scalar(100.3));
        values.at<float>(0, 0) = 0;
        values.at<float>(0, 1) = 255;
        const ScaledMap map{values, "none"};
        const auto range = rangeOf({map});
        const cv::Mat plain = mapToDisplay(map, range), image = mapToDisplay(map, range, {.dither = true});
        QCOMPARE(int(plain.at<unsigned char>(9, 9)), 100);
        QVERIFY(std::abs(cv::mean(image.rowRange(1, 300))[0] - 100.3) < 0.01);
        QVERIFY(cv::norm(image, plain, cv::NORM_INF) <= 1);
        QCOMPARE(cv::norm(image, mapToDisplay(map, range, {.dither = true}), cv::NORM_INF), 0.0);
        QVERIFY(cv::norm(image, mapToDisplay(map, range, {.dither = true, .seed = 2}), cv::NORM_INF) > 0);
        QCOMPARE(cv::countNonZero(mapToDisplay(map, {}, {.dither = true})), 0);  // A constant range stays blank.
    }

    void percentilesAreThoseOfAllObjectsTogether()
    {
        cv::Mat low(1, 1000, CV_32FC1), high(1, 1000, CV_32FC1);
        for (int j = 0; j < 1000; ++j) {
            low.at<float>(j) = static_cast<float>(j);
            high.at<float>(j) = static_cast<float>(1000 + j);
        }
        const std::vector<ScaledMap> maps{{low, "none"}, {high, "none"}};
        const auto whole = rangeOf(maps);
        RobustRange robust(whole);
        for (const auto& map : maps) robust.include(map);
        const auto range = robust.between(5, 90);
        QVERIFY2(std::abs(range.min - 100) < 1 && std::abs(range.max - 1800) < 1,
                 qPrintable(QString("%1 %2").arg(range.min).arg(range.max)));
        QCOMPARE(robust.between(0, 100).min, whole.min);
        QCOMPARE(robust.between(0, 100).max, whole.max);
        QVERIFY(std::abs(shareOutside(maps[0], range) - 0.1) < 0.002);
        // Nearly all pixels have one value, so the whole range is used.
        cv::Mat flat = cv::Mat::zeros(1, 1000, CV_32FC1);
        flat.at<float>(7) = 1;
        RobustRange mostlyFlat(rangeOf({{flat, "none"}}));
        mostlyFlat.include({flat, "none"});
        QVERIFY(!mostlyFlat.between(1, 99).constant());
    }

    void croppedVarianceIsReported()
    {
        const auto whole = compose(conditionNamed("h"), reliefOnly(ramp(240, 320)), DisplayScale::Pixels);
        QCOMPARE(*whole.varianceLost, 0.0);
        cv::Mat relief(800, 3280, CV_32FC1);
        for (int i = 0; i < relief.rows; ++i)
            for (int j = 0; j < relief.cols; ++j) relief.at<float>(i, j) = static_cast<float>((i + j) % 2);
        const auto cropped = compose(conditionNamed("h"), reliefOnly(relief), DisplayScale::Pixels);
        QVERIFY(std::abs(*cropped.varianceLost - (1 - 1280.0 / 3280)) < 1e-6);
        QVERIFY(!compose(conditionNamed("h"), reliefOnly(cv::Mat::ones(9, 9, CV_32FC1)), DisplayScale::Pixels).varianceLost);
    }

    void varianceThatTheDisplayCannotResolveIsReported()
    {
        // Half of the power is in a wave of 8 mm, half in one of 0.2 mm, which the display's pixels cannot resolve.
        cv::Mat relief(400, 400, CV_32FC1);
        for (int i = 0; i < 400; ++i)
            for (int j = 0; j < 400; ++j)
                relief.at<float>(i, j) = static_cast<float>(std::sin(2 * std::numbers::pi * j * 0.05 / 5) +
                                                            std::sin(2 * std::numbers::pi * i * 0.05 / 0.2));
        auto sources = reliefOnly(relief);
        sources.reliefMmPerPixel = 0.05;
        const auto map = compose(conditionNamed("h"), sources, DisplayScale::Physical);
        QVERIFY2(std::abs(*map.varianceLost - 0.5) < 0.02, qPrintable(QString::number(*map.varianceLost)));
    }

    void extremeHeightsHaveADefinedImage_data()
    {
        QTest::addColumn<double>("height");
        QTest::newRow("1 nm") << 1e-6;
        QTest::newRow("1 km") << 1e6;
        QTest::newRow("below 32 bits") << 1e-44;
        QTest::newRow("as large as is taken") << 9e29;
    }
    void extremeHeightsHaveADefinedImage()
    {
        QFETCH(double, height);
        cv::Mat relief(240, 320, CV_32FC1);
        for (int i = 0; i < relief.rows; ++i)
            for (int j = 0; j < relief.cols; ++j)
                relief.at<float>(i, j) = static_cast<float>(height * (0.5 + 0.5 * std::sin(0.5 * j + 0.1 * i)));
        auto sources = reliefOnly(relief);
        sources.reliefMmPerPixel = 0.05;
        sources.meanFriction = 0.5;
        for (const auto scale : {DisplayScale::Pixels, DisplayScale::Physical}) {
            const auto map = compose(conditionNamed("h&f"), sources, scale);
            QVERIFY(cv::checkRange(map.values));
            double least = 0, most = 0;
            cv::minMaxLoc(mapToDisplay(map, rangeOf({map})), &least, &most);
            const bool constant = rangeOf({map}).constant();  // 1e-44 may vanish in the filter.
            QVERIFY(constant ? most == 0 : least == 0 && most == 255);
        }
    }

    void longTracesAreCroppedToTheirMiddle()
    {
        Sources sources;
        sources.traceMmPerSample = 1e-5;  // 10^7 samples over 100 mm.
        sources.trace.resize(10000000);
        for (std::size_t i = 0; i < sources.trace.size(); ++i)
            sources.trace[i] = std::sin(2 * std::numbers::pi * static_cast<double>(i) * 1e-5 / 4) + (i % 2 == 0 ? 0.5 : -0.5);
        const auto map = compose(conditionNamed("f"), sources, DisplayScale::Physical);
        QVERIFY(cv::checkRange(map.values));
        QVERIFY(std::abs(*map.varianceLost - 1.0 / 3) < 0.02);  // The alternation is lost; the wave of 4 mm stays.
        QCOMPARE(compose(conditionNamed("f"), sources, DisplayScale::Pixels).values.size(), cv::Size(1280, 800));
    }

    /// Reason for a range over all fabrics: image by image, h&f would equal h.
    void meanFrictionIsFeltOnlyBecauseTheRangeIsCommon()
    {
        auto rough = reliefOnly(ramp(40, 40)), smooth = reliefOnly(ramp(40, 40).t());
        rough.meanFriction = 0.8;
        smooth.meanFriction = 0.2;
        const auto imageOf = [](const char* condition, const Sources& sources, const std::vector<Sources>& all) {
            std::vector<ScaledMap> maps;
            for (const auto& one : all)
                maps.push_back(compose(conditionNamed(condition), one, DisplayScale::Pixels, Extension::Mirror));
            return mapToDisplay(compose(conditionNamed(condition), sources, DisplayScale::Pixels, Extension::Mirror),
                                rangeOf(maps));
        };
        const cv::Mat alone = imageOf("h&f", smooth, {smooth}), reliefAlone = imageOf("h", smooth, {smooth});
        QVERIFY(cv::norm(alone, reliefAlone, cv::NORM_INF) <= 1);

        const cv::Mat together = imageOf("h&f", smooth, {rough, smooth}), relief = imageOf("h", smooth, {rough, smooth});
        QVERIFY(cv::norm(together, relief, cv::NORM_INF) > 180);
        double highest = 0;
        cv::minMaxLoc(together, nullptr, &highest);
        QCOMPARE(highest, 64.0);  // 255 * 0.2 / 0.8.
    }

    /// It would be felt upside down, and would shift the range of all fabrics.
    void reliefUnderNegativeFrictionIsRefused()
    {
        auto upsideDown = reliefOnly(ramp(4, 4));
        upsideDown.meanFriction = -0.4;
        const QString refusal = refusalOf([&] { compose(conditionNamed("h&f"), upsideDown, DisplayScale::Pixels); });
        QVERIFY2(refusal.contains("h&f") && refusal.contains("negative"), qPrintable(refusal));
        compose(conditionNamed("h"), upsideDown, DisplayScale::Pixels);
    }

    void brokenSignalsAreRefused()
    {
        cv::Mat broken = ramp(4, 4);
        broken.at<float>(1, 1) = std::numeric_limits<float>::quiet_NaN();
        QVERIFY(
            refusalOf([&] { compose(conditionNamed("h"), reliefOnly(broken), DisplayScale::Pixels); }).contains("not finite"));
        QVERIFY(refusalOf([&] { compose(conditionNamed("f"), {}, DisplayScale::Pixels); }).contains("empty"));
        broken.at<float>(1, 1) = std::numeric_limits<float>::infinity();
        QVERIFY(
            refusalOf([&] { compose(conditionNamed("h"), reliefOnly(broken), DisplayScale::Pixels); }).contains("not finite"));
        auto large = reliefOnly(ramp(4, 4));
        large.meanFriction = 1e40;
        QVERIFY(refusalOf([&] { compose(conditionNamed("h&f"), large, DisplayScale::Pixels); }).contains("not finite"));
        Sources trace;
        trace.trace = {0.1, 1e300};
        QVERIFY(refusalOf([&] { compose(conditionNamed("f"), trace, DisplayScale::Pixels); }).contains("not finite"));
    }
};

QTEST_GUILESS_MAIN(FrictionImageTest)
#include "friction_image_test.moc"
