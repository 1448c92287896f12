// What a rendering costs and gives up: errors and times that were put in are found again.
#include "study/making/rendering_prices.h"

#include <QTest>
#include <cmath>
#include <opencv2/core.hpp>

#include "protocols/condition.h"

using protocols::ConditionId;
using protocols::FabricId;
using protocols::Quality;
using rendering::RenderedFabrics;
using rendering::Signal;
using reports::PriceMeasure;
using study::making::accurateReferences;
using study::making::renderingPrices;

namespace {

FabricId fabric(int k) { return FabricId("F0" + std::to_string(k)); }

cv::Mat wave(double amplitude)
{
    cv::Mat map(60, 80, CV_32FC1);
    for (int y = 0; y < map.rows; ++y)
        for (int x = 0; x < map.cols; ++x)
            map.at<float>(y, x) = static_cast<float>(amplitude * std::sin(0.9 * x) * std::cos(0.7 * y));
    return map;
}

cv::Mat stripes(double depth)
{
    cv::Mat image(120, 160, CV_8UC1);
    for (int y = 0; y < image.rows; ++y)
        for (int x = 0; x < image.cols; ++x) image.at<uchar>(y, x) = cv::saturate_cast<uchar>(128 + depth * std::sin(0.6 * x));
    return image;
}

void addCondition(RenderedFabrics& rendering, const char* id, Quality quality, const cv::Mat& image, int fabrics)
{
    rendering::RenderedCondition condition;
    condition.condition = ConditionId(id);
    condition.quality = quality;
    for (int k = 1; k <= fabrics; ++k) condition.images[fabric(k)] = image;
    rendering.conditions.push_back(std::move(condition));
}

/// h_g@fast is 10 % too high and takes 2 ms, of the first fabric 900 ms; f_g@fast is 0.02 off a mean of 0.4; h_g and h agree.
RenderedFabrics renderingOf(int fabrics)
{
    RenderedFabrics rendering;
    for (int k = 1; k <= fabrics; ++k) {
        auto& fast = rendering.signalsAt[Quality::Fast][fabric(k)];
        auto& usual = rendering.signalsAt[Quality::Balanced][fabric(k)];
        auto& accurate = rendering.signalsAt[Quality::Accurate][fabric(k)];
        accurate.images[Signal::GeneratedHeight] = accurate.images[Signal::PhotometricHeight] = wave(0.1);
        usual.images[Signal::PhotometricHeight] = wave(0.1);
        fast.images[Signal::GeneratedHeight] = wave(0.11);
        fast.traces[Signal::GeneratedTrace] = std::vector<double>(50, 0.42);
        accurate.traces[Signal::GeneratedTrace] = std::vector<double>(50, 0.4);
        fast.generatedMeanFriction = 0.42;
        accurate.generatedMeanFriction = 0.4;
        for (auto* signals : {&fast, &usual, &accurate}) {
            signals->generatedMmPerPixel = signals->tactileMmPerPixel = 0.05;
            signals->milliseconds[Signal::GeneratedHeight] = signals == &fast ? (k == 1 ? 900.0 : 1.5 + 0.1 * k) : 40;
            signals->milliseconds[Signal::GeneratedSpectrogram] = 3;
            signals->milliseconds[Signal::PhotometricHeight] = 20;
            signals->milliseconds[Signal::Photograph] = 7;  // reading does not count
        }
    }
    addCondition(rendering, "h_g@fast", Quality::Fast, stripes(40), fabrics);
    addCondition(rendering, "f_g@fast", Quality::Fast, stripes(20), fabrics);
    addCondition(rendering, "h", Quality::Balanced, stripes(80), fabrics);
    addCondition(rendering, "h_g@accurate", Quality::Accurate, stripes(80), fabrics);
    addCondition(rendering, "f_g@accurate", Quality::Accurate, stripes(20), fabrics);
    addCondition(rendering, "h@accurate", Quality::Accurate, stripes(80), fabrics);
    return rendering;
}

const std::vector<ConditionId> shown{ConditionId("h_g@fast"), ConditionId("f_g@fast"), ConditionId("h")};

bool isNear(const stats::Value& value, double expected) { return value.exists() && std::abs(*value - expected) < 1e-4; }

}  // namespace

class RenderingPricesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyConditionWithAChoiceHasAnAccurateReference()
    {
        const auto references = accurateReferences(protocols::conditionList("v_grey,h_g@fast,h_g,h_g+f_g@accurate,h,f"));
        QStringList ids;
        for (const ConditionId& id : references) ids << QString::fromStdString(id.value);
        QCOMPARE(ids.join(' '), QString("h_g@accurate h@accurate"));
        QVERIFY(accurateReferences(protocols::conditionList("all")).empty());
    }

    void errorsThatWerePutInAreFound()
    {
        const auto prices = renderingPrices(shown, renderingOf(7));
        QCOMPARE(prices.size(), std::size_t{3});
        QCOMPARE(prices[0].condition, std::string("h_g@fast"));
        QVERIFY(isNear(prices[0][PriceMeasure::ReliefError].value, 10));
        QVERIFY(!prices[0][PriceMeasure::FrictionError].value.exists());
        QVERIFY(isNear(prices[1][PriceMeasure::FrictionError].value, 5));
        QCOMPARE(prices[1][PriceMeasure::ReliefError].value.why(), std::string("the condition has no relief"));
        QVERIFY(isNear(prices[2][PriceMeasure::ReliefError].value, 0));
        // The powers of the wave differ by 1.1 squared in its own bands. The others lie at the floor, and differ by nothing.
        const double decibels = *prices[0][PriceMeasure::HeightSpectrum].value;
        QVERIFY2(decibels > 0.02 && decibels < 20 * std::log10(1.1) + 0.05, qPrintable(QString::number(decibels)));
    }

    void theFingerFeelsWhatDiffers()
    {
        const auto prices = renderingPrices(shown, renderingOf(7));
        QVERIFY(*prices[0][PriceMeasure::FeltTexture].value > 0.5);
        QVERIFY(isNear(prices[1][PriceMeasure::FeltDifference].value, 0));
        const double both =
            std::hypot(*prices[0][PriceMeasure::FeltTexture].value, *prices[0][PriceMeasure::FeltSlipperiness].value);
        QVERIFY(isNear(prices[0][PriceMeasure::FeltDifference].value, both));
        // Accurate and measured images are the same here.
        QVERIFY(isNear(prices[0][PriceMeasure::FeltFromMeasured].value, both));
        QCOMPARE(prices[1][PriceMeasure::FeltFromMeasured].value.why(),
                 std::string("the study shows no measured signal of the same kind"));
    }

    void timesAreMediansWithOrderStatistics()
    {
        const auto time = renderingPrices(shown, renderingOf(7))[0][PriceMeasure::Milliseconds];
        QVERIFY(isNear(time.value, 2.0));  // 1.7 to 2.2 and 900
        // P(the median lies outside the extremes of 7) = 2 / 2^7 = 1.6 %; outside the next ones it is 12.5 %.
        QVERIFY(isNear(time.ci95.low, 1.7) && isNear(time.ci95.high, 900));
        const auto few = renderingPrices(shown, renderingOf(5))[0][PriceMeasure::Milliseconds];
        QVERIFY(few.value.exists());
        QCOMPARE(few.ci95.low.why(), std::string("needs at least 6 fabrics"));
        // R: qbinom(0.025, 9, 0.5) = 2, so one value at each end is left out.
        const auto nine = renderingPrices(shown, renderingOf(9))[0][PriceMeasure::Milliseconds];
        QVERIFY(isNear(nine.ci95.low, 1.8) && isNear(nine.ci95.high, 2.4));
    }

    void studiesWithoutQualitiesPayNothing() { QVERIFY(renderingPrices({ConditionId("h")}, renderingOf(3)).empty()); }
};

QTEST_GUILESS_MAIN(RenderingPricesTest)
#include "rendering_prices_test.moc"
