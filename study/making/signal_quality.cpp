#include "study/making/signal_quality.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "stats/metrics/image_metrics.h"
#include "stats/metrics/trace_error.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/t_tests.h"
#include "study/analyse/statistic_json.h"
#include "study/evaluation/friction_comparison.h"

namespace study::making {

namespace {

using analyse::put;
using nlohmann::ordered_json;
using rendering::FabricSignals;
using rendering::Signal;

constexpr double equivalenceShare = 0.10;  // share of the measured mean

struct FabricMeans {
    std::vector<double> generated, measured;
};

const cv::Mat* imageOf(const FabricSignals& signals, Signal signal)
{
    const auto found = signals.images.find(signal);
    return found == signals.images.end() || found->second.empty() ? nullptr : &found->second;
}

/// Central crops of both maps at the pitch of the measured one.
struct HeightPair {
    cv::Mat generated, measured;  // CV_64F
};

HeightPair commonCrop(const FabricSignals& signals, const cv::Mat& generated, const cv::Mat& measured)
{
    cv::Mat resampled = generated;
    const double ratio =
        signals.generatedMmPerPixel.value_or(1) / signals.tactileMmPerPixel.value_or(signals.generatedMmPerPixel.value_or(1));
    const auto scaled = [&](int side) { return std::max(1, cvRound(side * ratio)); };
    const bool isStrip = std::min(generated.cols, generated.rows) * ratio < 1;  // of which no row would be left
    const cv::Size kept = isStrip ? cv::Size(scaled(generated.cols), scaled(generated.rows)) : cv::Size();
    if (std::abs(ratio - 1) > 1e-6)
        cv::resize(generated, resampled, kept, ratio, ratio, ratio < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
    const cv::Size size(std::min(resampled.cols, measured.cols), std::min(resampled.rows, measured.rows));
    const auto centre = [&](const cv::Mat& map) {
        cv::Mat crop;
        map(cv::Rect({(map.cols - size.width) / 2, (map.rows - size.height) / 2}, size)).convertTo(crop, CV_64F);
        return crop;
    };
    return {centre(resampled), centre(measured)};
}

std::span<const double> pixels(const cv::Mat& map) { return {map.ptr<double>(), map.total()}; }

ordered_json tTest(const std::string& signal, const FabricMeans& pairs)
{
    ordered_json json{{"signal", signal}, {"unit", "fabric"}, {"n", pairs.measured.size()}};
    const auto test = stats::pairedTTest(pairs.generated, pairs.measured);
    put(json, "mean_difference", test.estimate);
    put(json, "statistic", test.t);
    put(json, "df", test.df);
    put(json, "p", test.p);
    put(json, "ci95", test.ci);

    double mean = 0;
    for (double value : pairs.measured) mean += value / static_cast<double>(pairs.measured.size());
    const double bound = equivalenceShare * std::abs(mean);
    ordered_json tost{{"bounds", {-bound, bound}}, {"bounds_are", "a tenth of the measured mean"}};
    if (bound > 0) {
        const auto equivalence =
            stats::equivalenceTest(stats::TKind::Paired, pairs.generated, pairs.measured, {-bound, bound, 0.05});
        put(tost, "p_lower", equivalence.pLower);
        put(tost, "p_upper", equivalence.pUpper);
        put(tost, "p", equivalence.p);
        put(tost, "ci90", equivalence.ci);
        tost["equivalent"] = equivalence.equivalent;
        tost["verdict"] = equivalence.verdict();
    } else {
        tost["equivalent"] = nullptr;
        tost["why"]["equivalent"] = "the measured mean is 0, so a tenth of it is not a bound";
    }
    json["tost"] = tost;
    return json;
}

bool hasBothFrictions(const FabricSignals& signals)
{
    return signals.traces.contains(Signal::GeneratedTrace) && signals.traces.contains(Signal::MeasuredTrace) &&
           signals.generatedMeanFriction && signals.measuredMeanFriction;
}

/// The generated trace at the spacing of the measured one, so that samples of one number lie at one place.
std::vector<double> generatedAtMeasured(const FabricSignals& signals)
{
    const evaluation::Trace generated{signals.traces.at(Signal::GeneratedTrace), signals.generatedTraceMmPerSample.value_or(0)};
    return evaluation::atSpacing(generated, signals.traceMmPerSample.value_or(0)).values;
}

/// Both traces of all fabrics, as far as both reach, and their means.
struct FrictionPairs {
    std::vector<double> generated, measured;
    FabricMeans means;
    std::string whyNone = "the study's conditions do not compute both the generated and the measured friction";
};

FrictionPairs frictionPairs(const std::map<protocols::FabricId, FabricSignals>& signals)
{
    FrictionPairs pairs;
    for (const auto& [fabric, of] : signals) {
        if (!hasBothFrictions(of)) continue;
        if (of.measuredQuantity != "mu") {
            pairs.whyNone = "the friction records contain " + of.measuredQuantity + ", not a coefficient of friction";
            continue;
        }
        const std::vector<double> g = generatedAtMeasured(of);
        const std::vector<double>& m = of.traces.at(Signal::MeasuredTrace);
        const auto length = static_cast<std::ptrdiff_t>(std::min(g.size(), m.size()));
        pairs.generated.insert(pairs.generated.end(), g.begin(), g.begin() + length);
        pairs.measured.insert(pairs.measured.end(), m.begin(), m.begin() + length);
        pairs.means.generated.push_back(*of.generatedMeanFriction);
        pairs.means.measured.push_back(*of.measuredMeanFriction);
    }
    return pairs;
}

void addFriction(const std::map<protocols::FabricId, FabricSignals>& signals, ordered_json& json, ordered_json& tests)
{
    const FrictionPairs pairs = frictionPairs(signals);
    if (pairs.measured.empty()) {
        const auto none = stats::Value::undefined(pairs.whyNone);
        put(json, "friction_mae", none);
        put(json, "friction_mae_over_mean", none);
        return;
    }
    const auto error = stats::traceError(pairs.generated, pairs.measured);
    put(json, "friction_mae", error.mae);
    put(json, "friction_mae_over_mean", error.maeOverMean);
    tests.push_back(tTest("friction", pairs.means));
}

void addHeight(const std::map<protocols::FabricId, FabricSignals>& signals, ordered_json& json, ordered_json& tests)
{
    std::vector<HeightPair> maps;
    FabricMeans means;
    double lowest = 0, highest = 0;
    for (const auto& [fabric, of] : signals) {
        const auto* generated = imageOf(of, Signal::GeneratedHeight);
        const auto* measured = imageOf(of, Signal::PhotometricHeight);
        if (!generated || !measured) continue;
        double low = 0, high = 0;
        cv::minMaxLoc(*measured, &low, &high);
        lowest = maps.empty() ? low : std::min(lowest, low);
        highest = maps.empty() ? high : std::max(highest, high);
        maps.push_back(commonCrop(of, *generated, *measured));
        means.generated.push_back(cv::mean(*generated)[0]);
        means.measured.push_back(cv::mean(*measured)[0]);
    }
    if (maps.empty()) {
        const auto none =
            stats::Value::undefined("the study's conditions do not compute both the generated and the measured height");
        put(json, "height_ssim", none);
        put(json, "height_range_mm", none);
        return;
    }
    double sum = 0;
    std::string why;
    for (const auto& map : maps) {
        const auto width = static_cast<std::size_t>(map.measured.cols), height = static_cast<std::size_t>(map.measured.rows);
        const auto similarity =
            stats::ssim({pixels(map.generated), width, height}, {pixels(map.measured), width, height}, highest - lowest);
        sum += similarity.mean.orElse(0);
        if (!similarity.mean.exists()) why = similarity.why;
    }
    put(json, "height_ssim", why.empty() ? stats::Value(sum / static_cast<double>(maps.size())) : stats::Value::undefined(why));
    json["height_range_mm"] = highest - lowest;
    tests.push_back(tTest("height", means));
}

}  // namespace

ordered_json signalQuality(const std::map<protocols::FabricId, FabricSignals>& signals)
{
    ordered_json json = ordered_json::object(), tests = ordered_json::array();
    addFriction(signals, json, tests);
    addHeight(signals, json, tests);
    json["t_tests"] = tests;
    return json;
}

}  // namespace study::making
