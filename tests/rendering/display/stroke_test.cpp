#include "rendering/display/stroke.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "protocols/files/csv_table.h"
#include "tests/rendering/refusal.h"

using namespace rendering;

namespace {

cv::Mat flat(int level) { return cv::Mat(800, 1280, CV_8UC1, cv::Scalar(level)); }

/// A wave of the given period in pixels along x.
cv::Mat grating(double period)
{
    cv::Mat image(800, 1280, CV_8UC1);
    for (int i = 0; i < 800; ++i)
        for (int j = 0; j < 1280; ++j)
            image.at<unsigned char>(i, j) =
                cv::saturate_cast<unsigned char>(127.5 + 127.5 * std::cos(2 * std::numbers::pi * j / period));
    return image;
}

double spanInTheMiddle(const std::vector<double>& force)
{
    const auto begin = force.begin() + static_cast<std::ptrdiff_t>(force.size() / 4);
    const auto [low, high] = std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(force.size() / 2));
    return *high - *low;
}

}  // namespace

class StrokeTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void flatImageGivesItsFrictionAllAlong_data()
    {
        QTest::addColumn<int>("level");
        QTest::addColumn<double>("force");
        QTest::newRow("bare glass") << 0 << 0.5 * 0.3;
        QTest::newRow("highest") << 255 << 0.5 * 0.9;
        QTest::newRow("between") << 51 << 0.5 * (0.3 + 0.6 * 0.2);
    }
    void flatImageGivesItsFrictionAllAlong()
    {
        QFETCH(int, level);
        QFETCH(double, force);
        const auto felt = strokeForce(flat(level), 400, false);
        // 1279 pixels of 0.170 mm at 50 mm/s and 1000 Hz, both ends counted.
        QCOMPARE(felt.size(), std::size_t(1279 * 0.170 / 50 * 1000) + 1);
        for (const double value : felt) QVERIFY(std::abs(value - force) < 1e-12);
    }

    void stepIsFollowedAsTheSkinResponds_data()
    {
        QTest::addColumn<double>("responseS");
        QTest::addColumn<double>("sampleRateHz");
        QTest::newRow("slow skin") << 0.02 << 1000.0;
        QTest::newRow("the model's own") << 0.002 << 1000.0;
        QTest::newRow("faster than its samples") << 0.0002 << 1000.0;
        QTest::newRow("coarse samples") << 0.02 << 50.0;
    }
    void stepIsFollowedAsTheSkinResponds()
    {
        // tau F' + F = d(t). Between two pixels d rises evenly, for T = pitch / speed; from its beginning on
        // F = d0 + a (t - tau + tau exp(-t/tau)) with a = (d1 - d0) / T, and after its end at T
        // F = d1 + (F(T) - d1) exp(-(t - T)/tau). The samples meet the ramp's ends exactly: 8.5 mm/s, 0.17 mm: T = 20 ms.
        QFETCH(double, responseS);
        QFETCH(double, sampleRateHz);
        cv::Mat image(3, 41, CV_8UC1, cv::Scalar(0));
        image.colRange(20, 41).setTo(255);
        StrokeOptions options;
        options.contactMm = 0.001;  // a needle: the step stays a step
        options.speedMmPerS = 8.5;
        options.responseS = responseS;
        options.sampleRateHz = sampleRateHz;
        const double d0 = 0.15, d1 = 0.45, begin = 19 * 0.02, rise = 0.02, tau = responseS;
        const auto onRamp = [&](double t) { return d0 + (d1 - d0) / rise * (t - tau + tau * std::exp(-t / tau)); };
        const auto expected = [&](double t) {
            if (t <= begin) return d0;
            if (t <= begin + rise) return onRamp(t - begin);
            return d1 + (onRamp(rise) - d1) * std::exp(-(t - begin - rise) / tau);
        };
        const auto samples = strokeImage(image, 1, false, options);
        QCOMPARE(samples.size(), static_cast<std::size_t>(std::lround(0.8 * sampleRateHz)) + 1);
        for (const auto& sample : samples) {
            QVERIFY(std::abs(sample.tangentialN - expected(sample.timeS)) < 1e-9);
            QVERIFY(std::abs(sample.positionMm - 8.5 * sample.timeS) < 1e-9);
            QCOMPARE(sample.normalN, 0.5);
        }
    }

    void sixteenBitImageIsFeltAsItsEightBitOne()
    {
        cv::Mat fine;
        const cv::Mat image = grating(40);
        image.convertTo(fine, CV_16U, 257);
        const auto coarseForce = strokeForce(image, 9, false), fineForce = strokeForce(fine, 9, false);
        QCOMPARE(coarseForce.size(), fineForce.size());
        for (std::size_t i = 0; i < fineForce.size(); ++i) QVERIFY(std::abs(fineForce[i] - coarseForce[i]) < 1e-12);
    }

    void smallestImagesHaveAForce_data()
    {
        QTest::addColumn<int>("width");
        QTest::addColumn<int>("height");
        QTest::addColumn<double>("contactMm");
        QTest::newRow("one pixel") << 1 << 1 << 0.5;
        QTest::newRow("one pixel under a broad finger") << 1 << 1 << 100.0;
        QTest::newRow("one row") << 9 << 1 << 0.5;
        QTest::newRow("one column") << 1 << 9 << 0.5;
    }
    void smallestImagesHaveAForce()
    {
        QFETCH(int, width);
        QFETCH(int, height);
        StrokeOptions options;
        QFETCH(double, contactMm);
        options.contactMm = contactMm;
        const cv::Mat image(height, width, CV_8UC1, cv::Scalar(255));
        for (const bool vertical : {false, true}) {
            const auto force = strokeForce(image, 0, vertical, options);
            QVERIFY(!force.empty());
            for (const double value : force) QVERIFY(std::abs(value - 0.45) < 1e-12);
        }
    }

    void speedOutOfRangeIsRefused_data()
    {
        QTest::addColumn<double>("speed");
        QTest::addColumn<QString>("told");
        QTest::newRow("none") << 0.0 << "speed (mm/s) of a stroke is 0";
        QTest::newRow("backwards") << -5.0 << "speed (mm/s) of a stroke is -5";
        QTest::newRow("no number") << std::nan("") << "speed (mm/s)";
        QTest::newRow("endless") << std::numeric_limits<double>::infinity() << "speed (mm/s)";
        QTest::newRow("as slow as moss") << 1e-5 << "a speed from 0.0217";
    }
    void speedOutOfRangeIsRefused()
    {
        QFETCH(double, speed);
        QFETCH(QString, told);
        StrokeOptions options;
        options.speedMmPerS = speed;
        const auto refusal = refusalOf([&] { strokeForce(flat(0), 0, false, options); });
        QVERIFY2(refusal.contains(told), qPrintable(refusal));
    }

    void fastestStrokeIsItsBeginning()
    {
        StrokeOptions options;
        options.speedMmPerS = 1e6;
        QCOMPARE(strokeForce(flat(0), 0, false, options), std::vector<double>{0.15});
    }

    void tableReadsBackExactly()
    {
        const auto samples = strokeImage(grating(30), 5, false);
        const auto table = protocols::csvTableFrom(strokeCsv(samples), "stroke");
        QCOMPARE(table.columns, (std::vector<std::string>{"t_s", "position_mm", "normal_n", "tangential_n"}));
        QCOMPARE(table.rows.size(), samples.size());
        for (std::size_t row = 0; row < samples.size(); ++row)
            QCOMPARE((StrokeSample{protocols::numberAt(table, row, 0), protocols::numberAt(table, row, 1),
                                   protocols::numberAt(table, row, 2), protocols::numberAt(table, row, 3)}),
                     samples[row]);
    }

    void fingerPadBlursFineTexture()
    {
        // Gaussian of sigma 0.25 mm: a wave of 2 mm keeps exp(-2 pi^2 sigma^2 / 4) = 0.73, one of 0.5 mm 0.7 %.
        StrokeOptions options;
        options.responseS = 0;
        const double coarse = spanInTheMiddle(strokeForce(grating(2 / 0.170), 400, false, options));
        const double fine = spanInTheMiddle(strokeForce(grating(0.5 / 0.170), 400, false, options));
        QVERIFY2(std::abs(coarse - 0.3 * 0.734) < 0.01, qPrintable(QString::number(coarse)));
        QVERIFY2(fine < 0.02 * 0.3, qPrintable(QString::number(fine)));
    }

    void verticalStrokeIsTheHorizontalOneOfTheTurnedImage()
    {
        const cv::Mat image = grating(17), turned = image.t();
        QCOMPARE(strokeForce(image, 100, false), strokeForce(turned, 100, true));
    }

    void strokeAlongTheEdgeStaysInTheImage()
    {
        const cv::Mat image = grating(23);
        QCOMPARE(strokeForce(image, 0, false), strokeForce(image, 799, false));
    }

    void fasterStrokeIsShorter()
    {
        StrokeOptions fast;
        fast.speedMmPerS = 100;
        const auto slowSamples = strokeForce(flat(1), 1, false).size(), fastSamples = strokeForce(flat(1), 1, false, fast).size();
        QVERIFY(std::abs(static_cast<double>(slowSamples) / static_cast<double>(fastSamples) - 2) < 0.01);
    }
};

QTEST_GUILESS_MAIN(StrokeTest)
#include "stroke_test.moc"
