#include "rendering/stroke.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

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

    void stepIsFollowedAsTheSkinResponds()
    {
        cv::Mat image = flat(0);
        image.colRange(640, 1280).setTo(255);
        StrokeOptions options;
        options.contactMm = 0.001;  // a needle: the step stays a step
        options.responseS = 0.02;
        const auto force = strokeForce(image, 10, false, options);
        const double stepS = 639.5 * 0.170 / 50, low = 0.15, high = 0.45;
        const auto at = [&](double timeS) { return force[static_cast<std::size_t>(std::lround(timeS * 1000))]; };
        QVERIFY(std::abs(at(stepS - 0.005) - low) < 1e-9);
        QVERIFY(std::abs(at(stepS + 0.02) - (high - (high - low) * std::exp(-1))) < 0.015);
        QVERIFY(std::abs(at(stepS + 0.2) - high) < 1e-4);
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
