// The `signals` object of results.json: known errors are found, and missing signals are reported.
#include "study/making/signal_quality.h"

#include <QTest>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

using rendering::FabricSignals;
using rendering::Signal;
using study::making::signalQuality;

namespace {

cv::Mat wave(int width, int height, float amplitude, float offset)
{
    cv::Mat map(height, width, CV_32FC1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            map.at<float>(y, x) = offset + amplitude * static_cast<float>(1 + std::sin(0.5 * x) * std::cos(0.3 * y)) / 2;
    return map;
}

/// Friction generated `offset` too high and `jitter` up and down, heights equal to the measured.
std::map<protocols::FabricId, FabricSignals> fabricsWith(double offset, double jitter)
{
    std::map<protocols::FabricId, FabricSignals> fabrics;
    for (int k = 0; k < 6; ++k) {
        FabricSignals signals;
        const double mean = 0.2 + 0.05 * k;
        for (int i = 0; i < 100; ++i) {
            signals.traces[Signal::MeasuredTrace].push_back(mean);
            signals.traces[Signal::GeneratedTrace].push_back(mean + offset + (i % 2 ? jitter : -jitter));
        }
        signals.measuredMeanFriction = mean;
        signals.generatedMeanFriction = mean + offset + 0.001 * (k - 2.5);
        signals.images[Signal::PhotometricHeight] = wave(40, 30, 0.2f, 0.f);
        signals.images[Signal::GeneratedHeight] = wave(40, 30, 0.2f, 0.f);
        signals.tactileMmPerPixel = signals.generatedMmPerPixel = 0.05;
        fabrics[protocols::FabricId("F0" + std::to_string(k + 1))] = signals;
    }
    return fabrics;
}

}  // namespace

class SignalQualityTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void theMeanAbsoluteErrorIsTheOneThatWasPutIn()
    {
        const auto json = signalQuality(fabricsWith(0.0, 0.02));
        QVERIFY(qAbs(json["friction_mae"].get<double>() - 0.02) < 1e-12);
        QVERIFY(qAbs(json["friction_mae_over_mean"].get<double>() - 0.02 / 0.325) < 1e-12);
        QCOMPARE(json["height_ssim"].get<double>(), 1.0);
    }

    void closeMeansAreEquivalentAndFarOnesAreNot()
    {
        const auto close = signalQuality(fabricsWith(0.0, 0.02))["t_tests"][0];
        QCOMPARE(close["signal"], "friction");
        QCOMPARE(close["n"], 6);
        QVERIFY(close["p"].get<double>() > 0.05);
        QCOMPARE(close["tost"]["equivalent"], true);
        const auto far = signalQuality(fabricsWith(0.2, 0.02))["t_tests"][0];
        QVERIFY(far["p"].get<double>() < 0.001);
        QCOMPARE(far["tost"]["equivalent"], false);
    }

    /// Counts of a tactile sensor were tested against the coefficient, with p < 1e-6.
    void recordsThatAreNoCoefficientAreNotCompared()
    {
        auto fabrics = fabricsWith(0.0, 0.02);
        FabricSignals& first = fabrics.begin()->second;
        first.measuredQuantity = "taxel_sum_counts";
        first.measuredMeanFriction = 2165;
        first.traces[Signal::MeasuredTrace].assign(100, 2165);
        const auto others = signalQuality(fabrics);
        QVERIFY(qAbs(others["friction_mae"].get<double>() - 0.02) < 1e-12);
        QCOMPARE(others["t_tests"][0]["n"], 5);
        for (auto& [id, signals] : fabrics) signals.measuredQuantity = "taxel_sum_counts";
        const auto none = signalQuality(fabrics);
        for (const char* field : {"friction_mae", "friction_mae_over_mean"}) {
            QVERIFY(none[field].is_null());
            QCOMPARE(none["why"][field].get<std::string>(),
                     std::string("the friction records contain taxel_sum_counts, not a coefficient of friction"));
        }
        for (const auto& test : none["t_tests"]) QVERIFY(test["signal"] != "friction");
    }

    void aTraceAtAnotherSpacingIsComparedPlaceByPlace()
    {
        auto fabrics = fabricsWith(0, 0);
        const auto friction = [](double mm) { return 0.3 + 0.1 * std::sin(mm); };
        for (auto& [id, signals] : fabrics) {
            auto &generated = signals.traces[Signal::GeneratedTrace], &measured = signals.traces[Signal::MeasuredTrace];
            generated.clear();
            measured.clear();
            for (int i = 0; i < 480; ++i) generated.push_back(friction(i / 12.0));
            for (int i = 0; i < 4800; ++i) measured.push_back(friction(i / 120.0));
            signals.generatedTraceMmPerSample = 1 / 12.0;
            signals.traceMmPerSample = 1 / 120.0;
        }
        QVERIFY(signalQuality(fabrics)["friction_mae"].get<double>() < 0.001);
    }

    void aMapAtAnotherPitchIsResampledFirst()
    {
        auto fabrics = fabricsWith(0, 0);
        for (auto& [id, signals] : fabrics) {
            cv::Mat& map = signals.images[Signal::GeneratedHeight];
            cv::resize(map.clone(), map, {}, 2, 2, cv::INTER_CUBIC);
            signals.generatedMmPerPixel = 0.025;
        }
        QVERIFY(signalQuality(fabrics)["height_ssim"].get<double>() > 0.97);
    }

    void signalsThatWereNotComputedAreNullWithTheirReason()
    {
        const auto json = signalQuality({});
        for (const char* field : {"friction_mae", "friction_mae_over_mean", "height_ssim", "height_range_mm"}) {
            QVERIFY(json[field].is_null());
            QVERIFY(json["why"][field].is_string());
        }
        QVERIFY(json["t_tests"].empty());
    }
};

QTEST_GUILESS_MAIN(SignalQualityTest)
#include "signal_quality_test.moc"
