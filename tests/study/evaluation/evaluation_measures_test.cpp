// Measures of `vis2hap evaluate` for a pair of signals: height maps, friction traces, identification of the fabric, averages.
#include <QTest>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "protocols/random.h"
#include "stats/metrics/spectrum_distance.h"
#include "study/evaluation/identification.h"
#include "study/evaluation/summary.h"

using namespace study::evaluation;

namespace {

/// A woven relief of three waves, shifted by `shiftMm` along its first axis and rotated in the picture.
HeightMap weave(double depthMm, double rotationDeg = 0, double shiftMm = 0, cv::Size size = {320, 240})
{
    HeightMap map{cv::Mat(size, CV_32FC1), 0.05, rotationDeg};
    const double angle = rotationDeg * std::numbers::pi / 180, turn = 2 * std::numbers::pi;
    for (int row = 0; row < size.height; ++row)
        for (int column = 0; column < size.width; ++column) {
            const double x = (column - (size.width - 1) / 2.0) * 0.05, y = (row - (size.height - 1) / 2.0) * 0.05;
            const double u = std::cos(angle) * x - std::sin(angle) * y + shiftMm, v = std::sin(angle) * x + std::cos(angle) * y;
            const double relief =
                std::sin(turn * u / 1.7) + 0.6 * std::sin(turn * v / 2.3) + 0.3 * std::sin(turn * (u + v) / 0.6);
            map.heightMm.at<float>(row, column) = static_cast<float>(depthMm * (2 + relief));
        }
    return map;
}

Values compared(const HeightMap& generated, const HeightMap& measured)
{
    Values values;
    compareHeights(generated, heightFeatures(generated, 240), measured, heightFeatures(measured, 240), 0.4, values);
    return values;
}

double at_(const Values& values, Measure measure) { return *at(values, measure); }

/// A random trace around `mean`. Another `salt` gives another trace with the same statistics.
Trace stroke(double mean, double roughness, std::uint64_t salt, double persistence = 0.8)
{
    protocols::Random random(salt);
    Trace trace{{}, 0.1};
    double wander = 0;
    for (int i = 0; i < 480; ++i) {
        wander = persistence * wander + random.normal();
        trace.values.push_back(mean * (1 + roughness * wander));
    }
    return trace;
}

Values compared(const Trace& generated, const Trace& measured)
{
    Values values;
    compareTraces(generated, measured, values);
    return values;
}

}  // namespace

class EvaluationMeasuresTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void equalMapsGivePerfectValues()
    {
        const Values values = compared(weave(0.1), weave(0.1));
        QVERIFY(std::abs(at_(values, Measure::Ssim) - 1) < 1e-12);
        QVERIFY(std::abs(at_(values, Measure::SsimRegistered) - 1) < 1e-12);
        QCOMPARE(at_(values, Measure::HeightSpectrum), 0.0);
        QCOMPARE(at_(values, Measure::SqRatio), 1.0);
    }

    void registrationFindsRotatedAndShiftedMaps_data()
    {
        QTest::addColumn<double>("rotation");
        for (const double rotation : {0.0, 30.0, 90.0, 135.0}) QTest::addRow("%g degrees", rotation) << rotation;
    }

    void registrationFindsRotatedAndShiftedMaps()
    {
        QFETCH(double, rotation);
        const Values values = compared(weave(0.1, rotation, 0.4, {256, 256}), weave(0.1, 2));
        QVERIFY2(at_(values, Measure::SsimRegistered) > 0.97, qPrintable(QString::number(at_(values, Measure::SsimRegistered))));
        QVERIFY(at_(values, Measure::Ssim) < 0.5);
        QVERIFY2(at_(values, Measure::HeightSpectrum) < 2.5,
                 qPrintable(QString::number(at_(values, Measure::HeightSpectrum))));  // independent of the direction
    }

    void mapWithUnknownRotationIsNotRotated()
    {
        HeightMap turned = weave(0.1, 30, 0, {256, 256});
        turned.rotationDeg = 0;
        QVERIFY(at_(compared(turned, weave(0.1)), Measure::SsimRegistered) < 0.7);
    }

    void flatterMapChangesTheRatioButNotTheNormalisedSimilarity()
    {
        const Values values = compared(weave(0.05), weave(0.1));
        QVERIFY(std::abs(at_(values, Measure::SqRatio) - 0.5) < 1e-3);
        QVERIFY(at_(values, Measure::HeightSpectrum) > 2.5 && at_(values, Measure::HeightSpectrum) < 6.03);
        QVERIFY(std::abs(at_(values, Measure::SsimNormalised) - 1) < 1e-4);
        QVERIFY(at_(values, Measure::Ssim) < 0.9);
        QVERIFY(std::abs(at_(values, Measure::SalRatio) - 1) < 0.01);
    }

    void flatMapHasSimilarityButNoRoughness()
    {
        const HeightMap flat{cv::Mat(240, 320, CV_32FC1, cv::Scalar(0.2)), 0.05, 0};
        const Values values = compared(flat, weave(0.1));
        QVERIFY(at(values, Measure::Ssim).exists() && at(values, Measure::SsimRegistered).exists());
        QVERIFY(at_(values, Measure::HeightSpectrum) > 10);
        QCOMPARE(at(values, Measure::SqRatio).why(), std::string(flatMapWhy));
    }

    void mapIsResampledToTheMeasuredPitch()
    {
        HeightMap coarse = weave(0.1);
        cv::resize(coarse.heightMm, coarse.heightMm, {160, 120}, 0, 0, cv::INTER_AREA);
        coarse.pitchMm = 0.1;
        const HeightMap back = atPitch(coarse, 0.05);
        QCOMPARE(back.heightMm.size(), cv::Size(320, 240));
        QVERIFY(at_(compared(back, weave(0.1)), Measure::Ssim) > 0.8);
    }

    void smallMapsGiveUndefinedMeasures()
    {
        const Values values = compared(weave(0.1, 0, 0, {7, 7}), weave(0.1));
        QVERIFY(!at(values, Measure::Ssim).exists() && !at(values, Measure::Ssim).why().empty());
        QVERIFY(!at(values, Measure::SsimRegistered).exists());
        QVERIFY(!at(values, Measure::HeightSpectrum).exists());
    }

    void traceIsComparedByMeanAndBySpectrum()
    {
        const Values same = compared(stroke(0.3, 0.05, 1), stroke(0.3, 0.05, 1));
        QCOMPARE(at_(same, Measure::FrictionMae), 0.0);
        QCOMPARE(at_(same, Measure::FrictionSpectrum), 0.0);
        const Values rougher = compared(stroke(0.6, 0.1, 1), stroke(0.3, 0.05, 1));
        QVERIFY(std::abs(at_(rougher, Measure::MeanFrictionError) - 1) < 0.05);
        QVERIFY(std::abs(at_(rougher, Measure::FrictionSpectrum) - 6.02) < 0.3);  // twice as rough relative to the mean
        const Values other = compared(stroke(0.3, 0.05, 2), stroke(0.3, 0.05, 1));
        QVERIFY(at_(other, Measure::FrictionSpectrum) < 2.5);
        QVERIFY(at_(other, Measure::FrictionMaeOverMean) > 0.05);
    }

    void constantTraceHasAnErrorButNoSpectrum()
    {
        const Trace measured = stroke(0.3, 0.05, 1);
        const Values values = compared(constantTrace(0.3, 480), measured);
        QVERIFY(!at(values, Measure::FrictionSpectrum).exists());
        QVERIFY(at_(values, Measure::FrictionMaeOverMean) >= *ownMeanError(measured) * 0.99);
        QVERIFY(*ownMeanError(measured) > 0.01);
    }

    void traceIsResampledToOneSpacing()
    {
        const Trace wide = atSpacing({{0, 1, 2, 3}, 0.2}, 0.1);
        QCOMPARE(wide.values, (std::vector<double>{0, 0.5, 1, 1.5, 2, 2.5, 3}));
        QCOMPARE(atSpacing({{0, 1}, 0.1005}, 0.1).values, (std::vector<double>{0, 1}));
    }

    /// Every second sample of a wave of 0.11 mm would look like a wave of 1.1 mm.
    void traceIsAveragedWhereItBecomesCoarser()
    {
        Trace fine{{}, 0.05};
        for (int i = 0; i < 400; ++i) fine.values.push_back(0.3 + std::sin(2 * std::numbers::pi * i * 0.05 / 0.11));
        const Trace coarse = atSpacing(fine, 0.1);
        QCOMPARE(coarse.values.size(), std::size_t(200));
        QCOMPARE(coarse.mmPerSample, 0.1);
        for (std::size_t i = 1; i + 1 < coarse.values.size(); ++i) QVERIFY(std::abs(coarse.values[i] - 0.3) < 0.05);
    }

    /// 32 samples of a record with half of the model's rate span as much as 64 samples of the model.
    void spectrumOfACoarserRecordSpansTheSameLength()
    {
        const Trace generated = stroke(0.3, 0.05, 1), measured = stroke(0.3, 0.05, 2, 0.5);
        const auto distance = [&](std::size_t segment) {
            const auto overMean = [](const Trace& trace) {
                double mean = 0;
                for (const double value : trace.values) mean += value / static_cast<double>(trace.values.size());
                std::vector<double> values = trace.values;
                for (double& value : values) value /= mean;
                return values;
            };
            return *stats::spectrumDistance(overMean(generated), overMean(measured), segment).decibels;
        };
        const auto spectrumOf = [&](double modelMmPerSample) {
            Values values;
            compareTraces(generated, measured, values, modelMmPerSample);
            return at_(values, Measure::FrictionSpectrum);
        };
        QVERIFY(std::abs(spectrumOf(0.05) - distance(32)) < 1e-9);
        QVERIFY(std::abs(spectrumOf(0.1) - distance(64)) < 1e-9 && std::abs(spectrumOf(0.1) - distance(32)) > 0.01);
        QCOMPARE(spectrumOf(0.1004), spectrumOf(0.1));
        QCOMPARE(spectrumOf(0), spectrumOf(0.1));
    }

    void fabricIsIdentifiedByHeightAndByFriction()
    {
        std::vector<std::vector<FeatureVector>> heights(3), frictions(3);
        const auto height = [](int k, std::uint64_t salt) {
            protocols::Random random(salt + 100 * static_cast<std::uint64_t>(k));
            return featureVector(
                heightFeatures(weave(0.05 * (k + 1) * random.uniform(0.9, 1.1), 0, random.uniform(0, 2), {120, 120}), 120));
        };
        const auto friction = [](int k, std::uint64_t salt) {
            return featureVector(frictionFeatures(stroke(0.3, 0.02, salt + 100 * static_cast<std::uint64_t>(k), 0.9 - 0.4 * k)));
        };
        for (int k = 0; k < 3; ++k)
            for (std::uint64_t salt = 0; salt < 12; ++salt) {
                heights[static_cast<std::size_t>(k)].push_back(height(k, salt));
                frictions[static_cast<std::size_t>(k)].push_back(friction(k, salt));
            }
        const Identifier byHeight(heights), byFriction(frictions);
        for (int k = 0; k < 3; ++k) {
            QCOMPARE(byHeight.classOf(height(k, 50)), std::optional(static_cast<std::size_t>(k)));
            QCOMPARE(byFriction.classOf(friction(k, 50)), std::optional(static_cast<std::size_t>(k)));
        }
        QVERIFY(!byHeight.classOf({1, 2}));
    }

    void classifierUsesTheCorrelationOfFeatures()
    {
        // The two classes differ by 1 in a direction with small spread. In the other direction both spread by 10.
        std::vector<std::vector<FeatureVector>> samples(2);
        protocols::Random random(7);
        for (int i = 0; i < 200; ++i)
            for (const double side : {-0.5, 0.5}) {
                const double wide = 10 * random.normal(), narrow = 0.1 * random.normal() + side;
                samples[side < 0 ? 0 : 1].push_back({wide + narrow, wide - narrow});
            }
        const Identifier identifier(samples);
        for (const double far : {-20.0, 0.0, 20.0}) {
            QCOMPARE(identifier.classOf({far + 0.5, far - 0.5}), std::optional<std::size_t>(1));
            QCOMPARE(identifier.classOf({far - 0.5, far + 0.5}), std::optional<std::size_t>(0));
        }
    }

    void identificationNeedsTwoFabricsButOneSampleOfEach()
    {
        QVERIFY(!Identifier({{{1, 2}, {2, 1}}}).classOf({1, 2}));
        const Identifier single({{{0, 0}}, {}, {{4, 0}}});
        QCOMPARE(single.classOf({3, 1}), std::optional<std::size_t>(2));
    }

    void samplesThatAreTooSmallForAllFeaturesAreLeftOut()
    {
        const Identifier identifier({{{9}, {0, 0}, {1, 0}}, {{4, 0}, {5, 0}, {0}}, {{2}}});
        QCOMPARE(identifier.classOf({0.5, 0}), std::optional<std::size_t>(0));
        QCOMPARE(identifier.classOf({4.5, 0}), std::optional<std::size_t>(1));
        QVERIFY(!identifier.classOf({2}));
    }

    void averagesAreTakenWithinFabricsFirst()
    {
        TestPlan plan;
        plan.fabrics = {{protocols::FabricId("F01"), false, {}, {}}, {protocols::FabricId("F02"), false, {}, {}}};
        std::vector<Values> ofPairs;
        const auto add = [&](std::size_t fabric, double mae, double ratio) {
            plan.pairs.push_back({fabric, {}, {}, {}, {}, {}});
            ofPairs.emplace_back();
            at(ofPairs.back(), Measure::FrictionMae) = mae;
            at(ofPairs.back(), Measure::SqRatio) = ratio;
            at(ofPairs.back(), Measure::Ssim) = stats::Value::undefined("none here");
        };
        add(0, 1, 0.5);
        add(0, 1, 2);
        add(0, 1, 1);
        add(1, 3, 4);
        const PredictorResult result = summarise({}, plan, ofPairs);
        QCOMPARE(*at(result.mean, Measure::FrictionMae), 2.0);
        QVERIFY(std::abs(*at(result.mean, Measure::SqRatio) - 2) < 1e-12);  // geometric mean of 1 and 4
        QCOMPARE(at(result.mean, Measure::Ssim).why(), std::string("none here"));
        QCOMPARE(result.fabrics[0].pairs, 3);
    }

    /// Expected numbers: the formulas of Student and Wilson, computed in Python.
    void meansHaveIntervalsOverFabrics()
    {
        const auto interval = [](Measure measure, const std::vector<stats::Value>& values) {
            return intervalOf(measure, values);
        };
        const auto isNear = [](const stats::Interval& found, double low, double high) {
            return std::abs(*found.low - low) < 1e-4 && std::abs(*found.high - high) < 1e-4;
        };
        const auto none = stats::Value::undefined("none here");
        QVERIFY(isNear(interval(Measure::FrictionMae, {1.0, 3.0, none, 2.5}), -0.4189, 4.7522));
        QVERIFY(isNear(interval(Measure::SqRatio, {1.0, 4.0, 2.0}), 0.3575, 11.1900));  // of the logarithms
        QVERIFY(isNear(interval(Measure::FrictionCovered, {1.0, 1.0, 0.0, 1.0}), 0.3006, 0.9544));
        QVERIFY(isNear(interval(Measure::IdentifiedByBoth, {1.0, 1.0, 1.0}), 0.4385, 1));
        QVERIFY(isNear(interval(Measure::IdentifiedByBoth, {1.0, 0.5, 1.0}), 0.1162, 1));  // several pairs of a fabric
        QVERIFY(!interval(Measure::FrictionMae, {1.0, none}).low.exists());
        QVERIFY(!interval(Measure::FrictionMae, {}).high.exists());
    }

    void equalMeansAreShownByEquivalenceNotByALargeP()
    {
        PredictorResult measured, close, wild;
        const double truth[] = {0.20, 0.30, 0.40, 0.30, 0.25};
        for (int i = 0; i < 5; ++i) {
            const auto add = [&](PredictorResult& to, double value) {
                to.fabrics.push_back({protocols::FabricId("F0" + std::to_string(i + 1)), 1, {}});
                at(to.fabrics.back().values, Measure::MeanFriction) = value;
            };
            add(measured, truth[i]);
            add(close, truth[i] + (i % 2 == 0 ? 0.004 : -0.005));
            add(wild, truth[i] + (i % 2 == 0 ? 0.1 : -0.12));
        }
        const auto shown = compareMeans(close, measured, Measure::MeanFriction, 0.1);
        QVERIFY(shown.equivalence.equivalent);
        QVERIFY(std::abs(shown.bound - 0.029) < 1e-12);
        const auto notShown = compareMeans(wild, measured, Measure::MeanFriction, 0.1);
        QVERIFY(!notShown.equivalence.equivalent && *notShown.equivalence.pDifference > 0.5);
        QCOMPARE(notShown.equivalence.n, std::size_t(5));
    }
};

QTEST_GUILESS_MAIN(EvaluationMeasuresTest)
#include "evaluation_measures_test.moc"
